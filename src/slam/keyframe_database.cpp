#include "slam/keyframe_database.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <shared_mutex>
#include <utility>

namespace cpslam {
namespace {

constexpr double kMinShareOfCommonWords = 0.8;
constexpr double kMinShareOfGroupScore = 0.75;
constexpr std::size_t kGroupSize = 10;

using Candidates = std::map<KeyFrameId, PlaceCandidate>;

/// Leaves those that share many words with the query and look enough like it.
void drop_unlike(Candidates& candidates, double min_score) {
  int most = 0;
  for (const auto& [id, candidate] : candidates) most = std::max(most, candidate.common_words);
  const auto fewest = static_cast<int>(std::ceil(kMinShareOfCommonWords * most));
  std::erase_if(candidates, [&](const auto& entry) {
    return entry.second.common_words < fewest || entry.second.score < min_score;
  });
}

struct Ranked {
  PlaceCandidate candidate;
  std::uint64_t sequence = 0;
};

/// For each keyframe the best one of its neighbourhood, with the score of the whole neighbourhood.
std::vector<Ranked> accumulate(const Map& map, const Candidates& candidates) {
  const std::shared_lock lock(map.mutex());
  std::map<KeyFrameId, Ranked> best_of_group;
  for (const auto& [id, candidate] : candidates) {
    if (map.keyframe(id) == nullptr) continue;
    double group_score = candidate.score;
    const PlaceCandidate* best = &candidate;
    for (const KeyFrameId neighbour : map.best_covisible(id, kGroupSize)) {
      const auto found = candidates.find(neighbour);
      if (found == candidates.end()) continue;
      group_score += found->second.score;
      if (found->second.score > best->score) best = &found->second;
    }
    Ranked& ranked = best_of_group[best->keyframe];
    if (group_score <= ranked.candidate.group_score) continue;
    ranked.candidate = *best;
    ranked.candidate.group_score = group_score;
    ranked.sequence = map.keyframe(best->keyframe)->sequence;
  }
  std::vector<Ranked> ranked;
  ranked.reserve(best_of_group.size());
  for (const auto& [id, group] : best_of_group) ranked.push_back(group);
  return ranked;
}

}  // namespace

void KeyFrameDatabase::add(KeyFrameId keyframe, std::shared_ptr<const ImageWords> words) {
  const std::lock_guard lock(mutex_);
  std::shared_ptr<const ImageWords>& entry = keyframes_[keyframe];
  if (entry != nullptr) erase_postings(keyframe, entry->bow);
  entry = std::move(words);
  for (const WordWeight& word : entry->bow) postings_.at(word.word).push_back({keyframe, word.weight});
}

void KeyFrameDatabase::erase(KeyFrameId keyframe) {
  const std::lock_guard lock(mutex_);
  const auto found = keyframes_.find(keyframe);
  if (found == keyframes_.end()) return;
  erase_postings(keyframe, found->second->bow);
  keyframes_.erase(found);
}

void KeyFrameDatabase::clear() {
  const std::lock_guard lock(mutex_);
  for (std::vector<Posting>& keyframes : postings_) keyframes.clear();
  keyframes_.clear();
}

void KeyFrameDatabase::erase_postings(KeyFrameId keyframe, const BowVector& bow) {
  for (const WordWeight& word : bow) {
    std::erase_if(postings_[word.word], [&](const Posting& posting) { return posting.keyframe == keyframe; });
  }
}

std::shared_ptr<const ImageWords> KeyFrameDatabase::words(KeyFrameId keyframe) const {
  const std::lock_guard lock(mutex_);
  const auto found = keyframes_.find(keyframe);
  return found == keyframes_.end() ? nullptr : found->second;
}

std::size_t KeyFrameDatabase::size() const {
  const std::lock_guard lock(mutex_);
  return keyframes_.size();
}

std::map<KeyFrameId, PlaceCandidate> KeyFrameDatabase::compare(const BowVector& bow,
                                                               std::span<const KeyFrameId> excluded) const {
  const std::set<KeyFrameId> left_out(excluded.begin(), excluded.end());
  const std::lock_guard lock(mutex_);
  Candidates candidates;
  for (const WordWeight& word : bow) {
    for (const Posting& posting : postings_.at(word.word)) {
      PlaceCandidate& candidate = candidates[posting.keyframe];
      candidate.keyframe = posting.keyframe;
      candidate.score += static_cast<double>(std::min(word.weight, posting.weight));
      ++candidate.common_words;
    }
  }
  std::erase_if(candidates, [&](const auto& entry) { return left_out.contains(entry.first); });
  return candidates;
}

std::vector<PlaceCandidate> KeyFrameDatabase::candidates(const Map& map, const BowVector& bow,
                                                         const PlaceQuery& query) const {
  Candidates alike = compare(bow, query.excluded);
  drop_unlike(alike, query.min_score);
  std::vector<Ranked> ranked = accumulate(map, alike);
  std::sort(ranked.begin(), ranked.end(), [](const Ranked& a, const Ranked& b) {
    if (a.candidate.group_score != b.candidate.group_score)
      return a.candidate.group_score > b.candidate.group_score;
    return a.sequence < b.sequence;
  });
  std::vector<PlaceCandidate> best;
  for (const Ranked& group : ranked) {
    if (best.size() == query.max_candidates) break;
    if (group.candidate.group_score < kMinShareOfGroupScore * ranked.front().candidate.group_score) break;
    best.push_back(group.candidate);
  }
  return best;
}

}  // namespace cpslam
