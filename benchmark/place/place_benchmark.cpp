// What recognising a place costs: words of an image, a query, and reading a vocabulary of a million words.
#include <benchmark/benchmark.h>

#include <filesystem>

#include "place/vocabulary_file.h"
#include "slam/keyframe_database.h"
#include "support/synthetic.h"

namespace cpslam {
namespace {

/// A full tree of random descriptors, with branching^depth words.
Vocabulary random_vocabulary(std::uint32_t branching, std::uint32_t depth) {
  Random random(1);
  VocabularyTree tree;
  tree.branching = branching;
  tree.depth = depth;
  std::size_t n_nodes = 0;
  std::size_t n_inner = 0;
  std::size_t n_level = 1;
  for (std::uint32_t level = 0; level <= depth; ++level, n_level *= branching) {
    n_inner = n_nodes;
    n_nodes += n_level;
  }
  for (std::size_t i = 0; i < n_nodes; ++i) tree.descriptors.push_back(synthetic::random_descriptor(random));
  for (std::size_t i = 0; i <= n_nodes; ++i)
    tree.first_child.push_back(static_cast<std::uint32_t>(1 + branching * std::min(i, n_inner)));
  for (std::size_t i = n_inner; i < n_nodes; ++i)
    tree.word_weights.push_back(static_cast<float>(random.uniform(1.0, 9.0)));
  return Vocabulary(std::move(tree));
}

std::vector<Descriptor> random_image(std::size_t n, Random& random) {
  std::vector<Descriptor> image;
  for (std::size_t i = 0; i < n; ++i) image.push_back(synthetic::random_descriptor(random));
  return image;
}

/// The argument is the number of levels of ten branches each.
void Transform1000(benchmark::State& state) {
  const Vocabulary vocabulary = random_vocabulary(10, static_cast<std::uint32_t>(state.range(0)));
  Random random(2);
  std::vector<std::vector<Descriptor>> images;
  for (int i = 0; i < 50; ++i) images.push_back(random_image(1000, random));
  std::size_t next = 0;
  for (auto _ : state) benchmark::DoNotOptimize(vocabulary.transform(images[next++ % images.size()]));
}
BENCHMARK(Transform1000)->ArgName("levels")->Arg(5)->Arg(6)->Unit(benchmark::kMillisecond);

/// A million words, from the disk's cache.
void LoadMillionWords(benchmark::State& state) {
  const std::string path = std::filesystem::temp_directory_path() / "cpslam_bench_million.voc";
  save_vocabulary(path, random_vocabulary(10, 6));
  for (auto _ : state) benchmark::DoNotOptimize(load_vocabulary(path));
  std::filesystem::remove(path);
}
BENCHMARK(LoadMillionWords)->Unit(benchmark::kMillisecond);

/// The argument is the number of keyframes: 1000 features each, of 20000 looks, so that every image has some
/// words in common with every other.
void Query(benchmark::State& state) {
  const Vocabulary vocabulary = random_vocabulary(10, 5);
  Random random(3);
  const std::vector<Descriptor> looks = random_image(20000, random);
  const auto image = [&] {
    std::vector<Descriptor> chosen;
    for (int i = 0; i < 1000; ++i) chosen.push_back(looks[random.index(looks.size())]);
    return chosen;
  };
  Map map(synthetic::pyramid());
  KeyFrameDatabase database(vocabulary.n_words());
  for (std::int64_t i = 0; i < state.range(0); ++i) {
    KeyFrame keyframe;
    keyframe.features = std::make_shared<FrameFeatures>();
    const KeyFrameId id = map.add_keyframe(std::move(keyframe));
    database.add(id, std::make_shared<const ImageWords>(vocabulary.transform(image())));
  }
  const BowVector bow = vocabulary.transform(image()).bow;
  for (auto _ : state) benchmark::DoNotOptimize(database.candidates(map, bow, {}));
}
BENCHMARK(Query)->ArgName("keyframes")->Arg(500)->Arg(2000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace cpslam
