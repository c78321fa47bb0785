#include "place/vocabulary_file.h"

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <utility>
#include <vector>

#include "cpslam/error.h"
#include "io/atomic_file.h"
#include "io/input_file.h"
#include "place/vocabulary_text.h"

namespace cpslam {
namespace {

static_assert(std::endian::native == std::endian::little, "the file's bytes are those of the memory");

constexpr std::array<char, 8> kMagic{'C', 'P', 'S', '-', 'V', 'O', 'C', '\n'};
constexpr std::uint32_t kVersion = 1;

struct Header {
  std::array<char, 8> magic = kMagic;
  std::uint32_t version = kVersion;
  std::uint32_t branching = 0;
  std::uint32_t depth = 0;
  std::uint32_t n_nodes = 0;
  std::uint32_t n_words = 0;
  std::uint32_t zero = 0;
  std::uint64_t identity = 0;
};
static_assert(sizeof(Header) == 40);

template <class T>
void append(std::string& bytes, std::span<const T> elements) {
  bytes.append(reinterpret_cast<const char*>(elements.data()), elements.size_bytes());
}

/// Takes the next elements.size() elements off the front of the bytes, which must be enough.
template <class T>
void take(std::string_view& bytes, std::span<T> elements) {
  std::memcpy(elements.data(), bytes.data(), elements.size_bytes());
  bytes.remove_prefix(elements.size_bytes());
}

std::uint64_t body_size(const Header& header) {
  return (std::uint64_t{header.n_nodes} - 1) * sizeof(Descriptor) +
         (std::uint64_t{header.n_nodes} + 1) * sizeof(std::uint32_t) +
         std::uint64_t{header.n_words} * sizeof(float);
}

Header take_header(std::string_view& bytes) {
  Header header;
  if (bytes.size() < sizeof header)
    throw InputError("the vocabulary is cut short: its header is not complete");
  std::memcpy(&header, bytes.data(), sizeof header);
  bytes.remove_prefix(sizeof header);
  if (header.version != kVersion) {
    throw InputError("the vocabulary is of version " + std::to_string(header.version) +
                     ", this program reads version " + std::to_string(kVersion) +
                     ": make it again with vocabulary_tool of this program");
  }
  if (header.zero != 0) throw InputError("the vocabulary is damaged: its header is not as it should be");
  if (header.n_nodes < 2)
    throw InputError("this is no vocabulary: it has " + std::to_string(header.n_nodes) + " nodes");
  const std::uint64_t expected = body_size(header);
  if (bytes.size() != expected) {
    throw InputError("the vocabulary is " + std::string(bytes.size() < expected ? "cut short" : "too long") +
                     ": " + std::to_string(bytes.size()) + " bytes follow its header, which promises " +
                     std::to_string(expected));
  }
  return header;
}

}  // namespace

std::string to_bytes(const Vocabulary& vocabulary) {
  const VocabularyTree& tree = vocabulary.tree();
  Header header;
  header.branching = tree.branching;
  header.depth = tree.depth;
  header.n_nodes = static_cast<std::uint32_t>(vocabulary.n_nodes());
  header.n_words = static_cast<std::uint32_t>(vocabulary.n_words());
  header.identity = vocabulary.identity();
  std::string bytes;
  bytes.reserve(sizeof header + body_size(header));
  append(bytes, std::span<const Header>(&header, 1));
  append(bytes, std::span(tree.descriptors).subspan(1));
  append(bytes, std::span(tree.first_child));
  append(bytes, std::span(tree.word_weights));
  return bytes;
}

Vocabulary vocabulary_from_bytes(std::string_view bytes) {
  const Header header = take_header(bytes);
  VocabularyTree tree;
  tree.branching = header.branching;
  tree.depth = header.depth;
  tree.descriptors.resize(header.n_nodes);
  tree.first_child.resize(std::size_t{header.n_nodes} + 1);
  tree.word_weights.resize(header.n_words);
  take(bytes, std::span(tree.descriptors).subspan(1));
  take(bytes, std::span(tree.first_child));
  take(bytes, std::span(tree.word_weights));
  Vocabulary vocabulary(std::move(tree));
  if (vocabulary.identity() != header.identity)
    throw InputError("the vocabulary is damaged: its checksum does not fit");
  return vocabulary;
}

Vocabulary load_vocabulary(const std::string& path) {
  const std::string bytes = read_regular_file(path, "vocabulary");
  try {
    const bool ours = bytes.starts_with(std::string_view(kMagic.data(), kMagic.size()));
    return ours ? vocabulary_from_bytes(bytes) : vocabulary_from_text(bytes);
  } catch (const InputError& error) {
    throw InputError("'" + path + "': " + error.what());
  }
}

void save_vocabulary(const std::string& path, const Vocabulary& vocabulary) {
  write_file_atomically(path, to_bytes(vocabulary));
}

}  // namespace cpslam
