#include <gtest/gtest.h>

#include "sim/paint.h"

namespace cpslam::sim {
namespace {

TEST(Paint, PrintedThingsFitWhateverTheSeed) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Random random(seed);
    for (const auto paint : {paint_poster, paint_paper, paint_book_cover, paint_screen, paint_whiteboard,
                             paint_notice_board, paint_label}) {
      EXPECT_EQ(paint(random).type(), CV_8UC3) << seed;
    }
  }
}

TEST(Paint, TheWidestSheetFitsIntoTheNoticeBoardsCorner) {
  Random random(1060);  // pins one to where it would hang over by a pixel
  EXPECT_EQ(paint_notice_board(random).cols, 640);
}

}  // namespace
}  // namespace cpslam::sim
