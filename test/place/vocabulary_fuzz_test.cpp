// Damaged files: an error or a vocabulary that works, never a crash (run under the sanitizers).
#include <gtest/gtest.h>

#include <sstream>

#include "cpslam/error.h"
#include "place/small_tree.h"
#include "place/vocabulary_file.h"
#include "place/vocabulary_text.h"

namespace cpslam {
namespace {

constexpr int kTrials = 3000;

std::string to_orb_text(const Vocabulary& vocabulary) {
  const VocabularyTree& tree = vocabulary.tree();
  std::ostringstream text;
  text << tree.branching << " " << tree.depth << " 0 0\n";
  std::vector<std::size_t> parents(vocabulary.n_nodes(), 0);
  WordId word = 0;
  for (std::size_t i = 0; i < vocabulary.n_nodes(); ++i) {
    for (std::size_t c = tree.first_child[i]; c < tree.first_child[i + 1]; ++c) parents[c] = i;
    const bool leaf = tree.first_child[i] == tree.first_child[i + 1];
    if (i == 0) continue;
    text << parents[i] << (leaf ? " 1" : " 0");
    for (const std::uint64_t w : tree.descriptors[i].words) {
      for (unsigned shift = 0; shift < 64; shift += 8) text << " " << ((w >> shift) & 0xFFU);
    }
    text << " " << (leaf ? tree.word_weights[word++] : 0.0F) << "\n";
  }
  return text.str();
}

/// Turns over, inserts, cuts out and repeats some bytes.
std::string damaged(std::string bytes, std::string_view alphabet, Random& random) {
  for (std::size_t n = 1 + random.index(4); n > 0 && !bytes.empty(); --n) {
    const std::size_t at = random.index(bytes.size());
    const char byte =
        alphabet.empty() ? static_cast<char>(random.next()) : alphabet[random.index(alphabet.size())];
    switch (random.index(6)) {
      case 0:
        bytes.resize(at);
        break;
      case 1:
        bytes.insert(at, 1, byte);
        break;
      case 2:
        bytes.erase(at, random.index(40));
        break;
      case 3:
        bytes.insert(at, bytes.substr(random.index(bytes.size()), random.index(200)));
        break;
      default:
        bytes[at] = byte;
    }
  }
  return bytes;
}

template <class Read>
int count_valid(const std::string& bytes, std::string_view alphabet, const Read& read) {
  Random random(17);
  const std::vector<Descriptor> image = test::random_images(1, 50, 50, random).front();
  int valid = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    try {
      const Vocabulary vocabulary = read(damaged(bytes, alphabet, random));
      const ImageWords words = vocabulary.transform(image);
      for (const WordWeight& word : words.bow) EXPECT_LT(word.word, vocabulary.n_words());
      ++valid;
    } catch (const InputError&) {
    }
  }
  return valid;
}

TEST(VocabularyFuzz, OurFormat) {
  const std::string bytes = to_bytes(test::random_vocabulary(5, 3, 2));
  const int valid = count_valid(bytes, {}, [](const std::string& b) { return vocabulary_from_bytes(b); });
  EXPECT_LT(valid, kTrials / 50) << "only what happens to change nothing";
}

TEST(VocabularyFuzz, OurFormatWithTheChecksumMadeToFit) {
  // An attacker can compute it: what then stands between him and the memory is the check of the tree.
  const Vocabulary vocabulary = test::random_vocabulary(3, 3, 3);
  Random random(18);
  int valid = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    VocabularyTree tree = vocabulary.tree();
    for (std::size_t n = 1 + random.index(3); n > 0; --n) {
      std::uint32_t& start = tree.first_child[random.index(tree.first_child.size())];
      start = random.uniform() < 0.5 ? static_cast<std::uint32_t>(random.next())
                                     : start + static_cast<std::uint32_t>(random.index(5)) - 2;
    }
    try {
      const Vocabulary changed(std::move(tree));
      (void)changed.transform(test::random_images(1, 20, 20, random).front());
      ++valid;
    } catch (const InputError&) {
    }
  }
  EXPECT_LT(valid, kTrials);
}

TEST(VocabularyFuzz, Text) {
  const Vocabulary vocabulary = test::random_vocabulary(4, 2, 4);
  const std::string text = to_orb_text(vocabulary);
  ASSERT_EQ(vocabulary_from_text(text).n_words(), vocabulary.n_words());
  const int valid = count_valid(text, "0123456789 .-e\n\r\tnaif",
                                [](const std::string& t) { return vocabulary_from_text(t); });
  EXPECT_GT(valid, 0) << "a changed byte of a descriptor is another vocabulary";
  EXPECT_LT(valid, kTrials);
}

}  // namespace
}  // namespace cpslam
