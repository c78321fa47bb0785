#include "place/vocabulary_text.h"

#include <bit>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "cpslam/error.h"

namespace cpslam {
namespace {

struct TextNode {
  std::uint32_t parent = 0;
  bool leaf = false;
  Descriptor descriptor;
  float weight = 0.0F;
};

/// Takes numbers off a text, one line after the other.
class LineReader {
 public:
  explicit LineReader(std::string_view text) : rest_(text) {}

  /// Goes on to the next line that is not blank; false at the end.
  bool next_line() {
    while (!rest_.empty()) {
      const std::size_t end = rest_.find('\n');
      line_ = rest_.substr(0, end);
      rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
      ++number_;
      skip_blanks();
      if (!line_.empty()) return true;
    }
    return false;
  }

  template <class T>
  T take(const char* what) {
    T value{};
    skip_blanks();
    const auto [end, error] = std::from_chars(line_.data(), line_.data() + line_.size(), value);
    if (error != std::errc()) fail(std::string("cannot read ") + what);
    line_.remove_prefix(static_cast<std::size_t>(end - line_.data()));
    return value;
  }

  void expect_end() {
    skip_blanks();
    if (!line_.empty()) fail("there is more than a node has");
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw InputError("this is no ORB vocabulary: line " + std::to_string(number_) + ": " + what);
  }

 private:
  void skip_blanks() {
    const std::size_t first = line_.find_first_not_of(" \t\r");
    line_.remove_prefix(first == std::string_view::npos ? line_.size() : first);
  }

  std::string_view rest_;
  std::string_view line_;
  std::size_t number_ = 0;
};

void read_header(LineReader& reader, VocabularyTree& tree) {
  if (!reader.next_line()) reader.fail("the file is blank");
  tree.branching = reader.take<std::uint32_t>("the number of branches");
  tree.depth = reader.take<std::uint32_t>("the number of levels");
  const auto scoring = reader.take<int>("the kind of scoring");
  const auto weighting = reader.take<int>("the kind of weighting");
  reader.expect_end();
  if (scoring != 0) reader.fail("scoring " + std::to_string(scoring) + " is not supported, only 0 (L1)");
  if (weighting != 0)
    reader.fail("weighting " + std::to_string(weighting) + " is not supported, only 0 (TF-IDF)");
}

TextNode read_node(LineReader& reader, std::size_t number) {
  TextNode node;
  node.parent = reader.take<std::uint32_t>("the parent's number");
  if (node.parent >= number) {
    reader.fail("node " + std::to_string(number) + " has the parent " + std::to_string(node.parent) +
                ", which does not come before it");
  }
  const auto leaf = reader.take<int>("whether it is a leaf");
  if (leaf != 0 && leaf != 1) reader.fail("a node is a leaf (1) or not (0), not " + std::to_string(leaf));
  node.leaf = leaf == 1;
  std::array<std::uint8_t, sizeof(Descriptor)> bytes{};
  for (std::uint8_t& byte : bytes) byte = reader.take<std::uint8_t>("a byte of the descriptor");
  std::memcpy(&node.descriptor, bytes.data(), bytes.size());
  node.weight = reader.take<float>("the weight");
  reader.expect_end();
  return node;
}

/// The nodes breadth first: by the rank of their parent, among siblings as they came.
void lay_out(std::span<const TextNode> nodes, VocabularyTree& tree) {
  const std::size_t n = nodes.size();
  std::vector<std::uint32_t> starts(n + 1, 0);  // of each one's children in `children`
  for (std::size_t i = 1; i < n; ++i) ++starts[nodes[i].parent + 1];
  std::partial_sum(starts.begin(), starts.end(), starts.begin());
  std::vector<std::uint32_t> children(n - 1);
  std::vector<std::uint32_t> next(starts.begin(), starts.end() - 1);
  for (std::size_t i = 1; i < n; ++i) children[next[nodes[i].parent]++] = static_cast<std::uint32_t>(i);

  std::vector<std::uint32_t> order{0};
  order.reserve(n);
  for (std::size_t rank = 0; rank < order.size(); ++rank) {
    const std::uint32_t i = order[rank];
    tree.descriptors.push_back(nodes[i].descriptor);
    tree.first_child.push_back(static_cast<std::uint32_t>(order.size()));
    const bool leaf = starts[i] == starts[i + 1];
    if (leaf != nodes[i].leaf) {
      throw InputError("this is no ORB vocabulary: node " + std::to_string(i) +
                       (leaf ? " is no leaf and has no children" : " is a leaf and has children"));
    }
    if (leaf) tree.word_weights.push_back(nodes[i].weight);
    for (std::uint32_t c = starts[i]; c < starts[i + 1]; ++c) order.push_back(children[c]);
  }
  tree.first_child.push_back(static_cast<std::uint32_t>(n));
}

}  // namespace

Vocabulary vocabulary_from_text(std::string_view text) {
  static_assert(std::endian::native == std::endian::little, "a descriptor's bytes are those of its words");
  LineReader reader(text);
  VocabularyTree tree;
  read_header(reader, tree);
  std::vector<TextNode> nodes(1);
  while (reader.next_line()) nodes.push_back(read_node(reader, nodes.size()));
  lay_out(nodes, tree);
  return Vocabulary(std::move(tree));
}

}  // namespace cpslam
