// measure_vocabulary: how well vocabularies tell places apart, as a Markdown table. Vocabulary/README.md has
// its numbers.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "common/run_program.h"
#include "place/vocabulary_file.h"
#include "place_queries.h"

namespace cpslam::bench {
namespace {

struct MeasureOptions {
  std::vector<std::string> vocabularies;
  std::vector<std::string> sources;
  std::size_t step = 5;
  std::size_t n_shown = 0;
  QueryOptions query;
};

std::vector<PlacedImage> load_all(const MeasureOptions& options) {
  std::vector<PlacedImage> images;
  std::size_t n_sequences = 0;
  for (std::size_t i = 0; i < options.sources.size(); ++i) {
    for (PlacedImage& image : load_places(options.sources[i], options.step, n_sequences)) {
      image.source = i;
      images.push_back(std::move(image));
    }
  }
  return images;
}

void print_row(const std::string& vocabulary, const std::string& queries,
               const std::vector<Answer>& answers) {
  const PlaceQuality quality = judge(answers);
  std::printf("| %s | %s | %zu | %zu | %.3f | %zu | %.3f | %.3f |\n", vocabulary.c_str(), queries.c_str(),
              answers.size(), quality.answerable, quality.recall_at_1(), quality.wrong,
              quality.recall_without_false, quality.recall_with_1_percent_false);
  std::fflush(stdout);
}

void show_mistakes(std::vector<Answer> answers, const std::vector<PlacedImage>& images, std::size_t n) {
  std::erase_if(answers, [](const Answer& answer) { return answer.relation != Relation::kOther; });
  std::sort(answers.begin(), answers.end(),
            [](const Answer& a, const Answer& b) { return a.score > b.score; });
  for (std::size_t i = 0; i < std::min(n, answers.size()); ++i) {
    std::printf("%.3f %s taken for %s\n", answers[i].score, images[answers[i].query].path.c_str(),
                images[answers[i].first].path.c_str());
  }
}

int measure(const MeasureOptions& options) {
  const std::vector<PlacedImage> images = load_all(options);
  std::printf(
      "| vocabulary | queries from | queries | answerable | recall@1 | wrong first | recall, no false | "
      "recall, 1 %% "
      "false |\n|---|---|---|---|---|---|---|---|\n");
  for (const std::string& path : options.vocabularies) {
    const Vocabulary vocabulary = load_vocabulary(path);
    const std::vector<Answer> answers = ask(vocabulary, images, options.query);
    for (std::size_t source = 0; source < options.sources.size(); ++source) {
      std::vector<Answer> of_source;
      for (const Answer& answer : answers)
        if (images[answer.query].source == source) of_source.push_back(answer);
      print_row(path, options.sources[source], of_source);
    }
    print_row(path, "all", answers);
    show_mistakes(answers, images, options.n_shown);
  }
  return program::kExitOk;
}

}  // namespace
}  // namespace cpslam::bench

int main(int argc, char** argv) {
  using namespace cpslam;
  bench::MeasureOptions options;
  CLI::App app{
      "Asks every picture of some places for the most alike among all others, and compares with the "
      "truth.\n\n"
      "Example: measure_vocabulary Vocabulary/cpslam.voc other.voc --places fr1_desk_dev people/val.txt"};
  app.add_option("VOCABULARIES", options.vocabularies, "Vocabularies to compare")->required();
  app.add_option("--places", options.sources,
                 "Sequences in TUM format with groundtruth.txt; lists or folders of pictures that all show "
                 "other places")
      ->required();
  app.add_option("--step", options.step, "Use every so many-th picture")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--exclude", options.query.exclude_s, "Seconds around a picture that do not count")
      ->capture_default_str();
  app.add_option("--near", options.query.near_m, "The same place: at most so many metres apart")
      ->capture_default_str();
  app.add_option("--near-angle", options.query.near_deg, "and turned by at most so many degrees")
      ->capture_default_str();
  app.add_option("--show", options.n_shown, "Name so many of the most convinced mistakes");
  return program::run_program("measure_vocabulary", [&] {
    if (const std::optional<int> exit_code = program::parse(app, "measure_vocabulary", argc, argv))
      return *exit_code;
    return bench::measure(options);
  });
}
