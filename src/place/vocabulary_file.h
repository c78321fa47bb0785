#pragma once

#include <string>
#include <string_view>

#include "place/vocabulary.h"

namespace cpslam {

/// Reads a vocabulary of either kind: ours, told by its first bytes, or the text of public ORB vocabularies
/// (place/vocabulary_text.h). Throws InputError that names the file and what is wrong when it is missing, no
/// regular file, of another version, cut short, too long, damaged, or no tree.
[[nodiscard]] Vocabulary load_vocabulary(const std::string& path);

/// Writes our own format, whole or not at all. Throws RunError that names the file and the cause.
void save_vocabulary(const std::string& path, const Vocabulary& vocabulary);

/// The bytes of our own format, everything little-endian, nothing padded:
///   8 bytes "CPS-VOC\n"; u32 version (1), branching, depth, nodes, words; u32 0; u64 identity;
///   32 bytes for each node but the root: its descriptor; u32 for each node and one more: its first child
///   (VocabularyTree says what that means); f32 for each word: its weight.
/// The identity is the checksum: a hash of all that follows it and of branching and depth.
[[nodiscard]] std::string to_bytes(const Vocabulary& vocabulary);

/// Throws InputError that does not know the file.
[[nodiscard]] Vocabulary vocabulary_from_bytes(std::string_view bytes);

}  // namespace cpslam
