#include "vocabulary_report.h"

#include <algorithm>
#include <array>
#include <cstdio>

namespace cpslam::program {
namespace {

std::string nodes_by_level(const VocabularyTree& tree) {
  std::string text;
  for (std::size_t begin = 0, end = 1; begin < end;) {
    text += (text.empty() ? "" : ", ") + std::to_string(end - begin);
    const std::size_t next_end = tree.first_child[end];
    begin = end;
    end = next_end;
  }
  return text;
}

}  // namespace

std::string to_text(const Vocabulary& vocabulary) {
  const VocabularyTree& tree = vocabulary.tree();
  const auto [least, most] = std::minmax_element(tree.word_weights.begin(), tree.word_weights.end());
  std::array<char, 512> text{};
  std::snprintf(text.data(), text.size(),
                "branching   %u\nlevels      %u\nnodes       %zu\nwords       %zu\nweights     %.3f to %.3f\n"
                "identity    %016llx\n",
                tree.branching, tree.depth, vocabulary.n_nodes(), vocabulary.n_words(),
                static_cast<double>(*least), static_cast<double>(*most),
                static_cast<unsigned long long>(vocabulary.identity()));
  return text.data() + ("by level    " + nodes_by_level(tree) + " nodes\n");
}

}  // namespace cpslam::program
