#include "util/log.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

namespace cpslam {
namespace {

TEST(Log, HandsLevelAndTextToTheSink) {
  std::vector<std::pair<LogLevel, std::string>> received;
  const Log log([&](LogLevel level, const std::string& message) { received.emplace_back(level, message); });
  log.debug("d");
  log.info("i");
  const Log copy = log;
  copy.warning("w");
  copy.error("e");
  const std::vector<std::pair<LogLevel, std::string>> expected = {
      {LogLevel::kDebug, "d"}, {LogLevel::kInfo, "i"}, {LogLevel::kWarning, "w"}, {LogLevel::kError, "e"}};
  EXPECT_EQ(received, expected);
}

TEST(Log, WithoutASinkDropsMessages) {
  EXPECT_NO_THROW(Log().error("nobody listens"));
  EXPECT_NO_THROW(Log(LogSink()).info("nobody listens"));
}

}  // namespace
}  // namespace cpslam
