#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <string>

#include "sim/paint.h"

namespace cpslam::sim {
namespace {

int whole(double value) {
  return static_cast<int>(std::lround(value));
}
int pick(Random& random, int n) {
  return static_cast<int>(random.index(static_cast<std::size_t>(n)));
}

void soften(cv::Mat& image) {
  cv::GaussianBlur(image, image, {3, 3}, 0.6);
}

// A picture as in a photograph: sky, hills, sun, a few trees.
void draw_landscape(cv::Mat& image, const cv::Rect& area, Random& random) {
  cv::Mat view = image(area);
  const cv::Scalar sky = random_colour(random, 130, 240);
  for (int y = 0; y < view.rows; ++y) view.row(y).setTo(sky * (0.7 + 0.3 * y / view.rows));
  cv::circle(view, {pick(random, view.cols), view.rows / 4}, view.rows / 10, {190, 230, 250}, cv::FILLED,
             cv::LINE_AA);
  for (int layer = 0; layer < 3; ++layer) {
    const cv::Scalar colour = random_colour(random, 30, 150 - 30.0 * layer);
    std::vector<cv::Point> outline{{0, view.rows}};
    for (int i = 0; i <= 8; ++i)
      outline.emplace_back(i * view.cols / 8,
                           whole(view.rows * (0.4 + 0.2 * layer + random.uniform(-0.12, 0.12))));
    outline.emplace_back(view.cols, view.rows);
    cv::fillPoly(view, std::vector<std::vector<cv::Point>>{outline}, colour, cv::LINE_AA);
  }
}

void draw_chart(cv::Mat& image, const cv::Rect& area, Random& random) {
  cv::Mat view = image(area);
  view.setTo(cv::Scalar(248, 248, 248));
  const bool bars = random.uniform() < 0.5;
  constexpr int kColumns = 8;
  cv::Point last;
  for (int i = 0; i < kColumns; ++i) {
    const int height = whole(view.rows * random.uniform(0.15, 0.9));
    const int x = (2 * i + 1) * view.cols / (2 * kColumns);
    const cv::Point top(x, view.rows - height);
    if (bars) {
      cv::rectangle(view, {x - view.cols / 24, view.rows - height}, {x + view.cols / 24, view.rows},
                    random_colour(random, 40, 210), cv::FILLED);
    } else {
      cv::circle(view, top, std::max(2, view.rows / 40), {40, 40, 170}, cv::FILLED, cv::LINE_AA);
      if (i > 0) cv::line(view, last, top, {150, 60, 30}, 2, cv::LINE_AA);
    }
    last = top;
  }
  cv::rectangle(view, {0, 0, view.cols, view.rows}, {60, 60, 60}, 2);
}

void draw_shapes(cv::Mat& image, const cv::Rect& area, Random& random) {
  cv::Mat view = image(area);
  view.setTo(random_colour(random, 120, 235));
  for (int i = 0; i < 9; ++i) {
    const cv::Point centre(pick(random, view.cols), pick(random, view.rows));
    const int size = view.cols / 14 + pick(random, view.cols / 7);
    const cv::Scalar colour = random_colour(random, 20, 230);
    if (i % 3 == 0) {
      cv::circle(view, centre, size / 2, colour, cv::FILLED, cv::LINE_AA);
    } else if (i % 3 == 1) {
      cv::rectangle(view, {centre.x - size / 2, centre.y - size / 3, size, 2 * size / 3}, colour, cv::FILLED);
    } else {
      const std::vector<cv::Point> triangle{
          centre, {centre.x + size, centre.y + size / 3}, {centre.x, centre.y + size}};
      cv::fillConvexPoly(view, triangle, colour, cv::LINE_AA);
    }
  }
}

void draw_figure(cv::Mat& image, const cv::Rect& area, Random& random) {
  switch (pick(random, 3)) {
    case 0:
      return draw_landscape(image, area, random);
    case 1:
      return draw_chart(image, area, random);
    default:
      return draw_shapes(image, area, random);
  }
}

void draw_heading(cv::Mat& image, const cv::Rect& area, const cv::Scalar& ink, Random& random) {
  const std::string word = random_word(random, 5, 9);
  const double scale = std::min(area.height / 30.0, area.width / (20.0 * static_cast<double>(word.size())));
  cv::putText(image, word, {area.x, area.y + area.height - 6}, cv::FONT_HERSHEY_DUPLEX, scale, ink,
              std::max(1, whole(2.2 * scale)), cv::LINE_AA);
}

}  // namespace

std::string random_word(Random& random, std::size_t shortest, std::size_t longest) {
  static constexpr char kConsonants[] = "bcdfghklmnprstvz";
  static constexpr char kVowels[] = "aeiou";
  std::string word;
  const std::size_t length = shortest + random.index(longest - shortest + 1);
  for (std::size_t i = 0; i < length; ++i)
    word += i % 2 == 0 ? kConsonants[random.index(16)] : kVowels[random.index(5)];
  word[0] = static_cast<char>(word[0] - 'a' + 'A');
  return word;
}

void draw_text_block(cv::Mat& image, const cv::Rect& area, double letter_px, const cv::Scalar& ink,
                     Random& random) {
  const double scale = letter_px / 22.0;
  for (double y = area.y + letter_px; y < area.y + area.height; y += 1.7 * letter_px) {
    std::string line;
    const auto n_letters =
        static_cast<std::size_t>(area.width / (0.85 * letter_px) * random.uniform(0.6, 1.0));
    while (line.size() < n_letters) line += random_word(random, 2, 8) + ' ';
    line.resize(n_letters);
    cv::putText(image, line, {area.x, whole(y)}, cv::FONT_HERSHEY_SIMPLEX, scale, ink, 1, cv::LINE_AA);
  }
}

cv::Mat paint_poster(Random& random) {
  cv::Mat image(724, 512, CV_8UC3, random_colour(random, 190, 250));
  const cv::Scalar ink = random_colour(random, 10, 90);
  if (random.uniform() < 0.5)
    cv::rectangle(image, {0, 0, 512, 110}, random_colour(random, 60, 190), cv::FILLED);
  draw_heading(image, {30, 20, 450, 70}, ink, random);
  draw_figure(image, {36, 130, 440, 250 + pick(random, 80)}, random);
  if (random.uniform() < 0.6) {
    draw_text_block(image, {36, 480, 210, 210}, 13, ink, random);
    draw_figure(image, {270, 490, 206, 190}, random);
  } else {
    draw_text_block(image, {36, 480, 440, 200}, 20, ink, random);
  }
  soften(image);
  return image;
}

cv::Mat paint_paper(Random& random) {
  cv::Mat image(362, 256, CV_8UC3, cv::Scalar(238, 240, 240));
  draw_heading(image, {24, 16, 200, 36}, {30, 30, 30}, random);
  const bool figure = random.uniform() < 0.6;
  draw_text_block(image, {24, 60, 208, figure ? 130 : 270}, 9, {60, 60, 60}, random);
  if (figure) draw_figure(image, {34, 210, 188, 120}, random);
  soften(image);
  return image;
}

cv::Mat paint_book_spine(Random& random) {
  const cv::Scalar cover = random_colour(random, 25, 210);
  cv::Mat lying(64, 384, CV_8UC3, cover);
  const bool dark = cover[0] + cover[1] + cover[2] < 330.0;
  const cv::Scalar ink = dark ? cv::Scalar(225, 228, 230) : cv::Scalar(30, 25, 25);
  const cv::Scalar band = random_colour(random, 30, 230);
  cv::rectangle(lying, {16 + pick(random, 20), 0, 6 + pick(random, 22), 64}, band, cv::FILLED);
  cv::rectangle(lying, {350 - pick(random, 20), 0, 8 + pick(random, 12), 64}, band, cv::FILLED);
  draw_heading(lying, {80, 8, 190, 44}, ink, random);
  cv::rectangle(lying, {0, 0, 384, 5}, cover * 0.6, cv::FILLED);
  cv::rectangle(lying, {0, 59, 384, 5}, cover * 0.6, cv::FILLED);
  cv::Mat image;
  cv::rotate(lying, image, cv::ROTATE_90_CLOCKWISE);
  soften(image);
  return image;
}

cv::Mat paint_book_cover(Random& random) {
  cv::Mat image(320, 230, CV_8UC3, random_colour(random, 40, 220));
  draw_heading(image, {20, 20, 190, 50}, random_colour(random, 180, 250), random);
  draw_figure(image, {30, 100, 170, 150}, random);
  draw_heading(image, {50, 270, 120, 26}, {20, 20, 20}, random);
  soften(image);
  return image;
}

cv::Mat paint_screen(Random& random) {
  cv::Mat image(320, 512, CV_8UC3);
  switch (pick(random, 3)) {
    case 0: {  // an editor
      image.setTo(cv::Scalar(44, 38, 36));
      cv::rectangle(image, {0, 0, 512, 20}, {80, 76, 74}, cv::FILLED);
      cv::rectangle(image, {0, 20, 96, 300}, {58, 52, 48}, cv::FILLED);
      draw_text_block(image, {8, 30, 80, 200}, 8, {170, 170, 170}, random);
      for (int i = 0; i < 15; ++i) {
        const cv::Scalar ink = random_colour(random, 120, 250);
        const int indent = 16 * pick(random, 4);
        draw_text_block(image, {106 + indent, 26 + 19 * i, 240 - indent, 14}, 11, ink, random);
      }
      draw_chart(image, {368, 200, 136, 104}, random);
      break;
    }
    case 1:  // a desktop with windows
      draw_landscape(image, {0, 0, 512, 320}, random);
      for (int i = 0; i < 2; ++i) {
        const cv::Rect window(30 + 210 * i + pick(random, 20), 40 + pick(random, 60), 200, 170);
        cv::rectangle(image, window, {245, 245, 245}, cv::FILLED);
        cv::rectangle(image, {window.x, window.y, window.width, 18}, random_colour(random, 70, 200),
                      cv::FILLED);
        draw_text_block(image, {window.x + 8, window.y + 26, 180, 130}, 10, {50, 50, 50}, random);
      }
      cv::rectangle(image, {0, 300, 512, 20}, {60, 60, 60}, cv::FILLED);
      break;
    default:  // a web page
      image.setTo(cv::Scalar(250, 248, 246));
      cv::rectangle(image, {0, 0, 512, 48}, random_colour(random, 80, 190), cv::FILLED);
      draw_heading(image, {20, 8, 200, 34}, {250, 250, 250}, random);
      draw_figure(image, {20, 64, 220, 130}, random);
      draw_text_block(image, {260, 64, 230, 130}, 11, {60, 50, 50}, random);
      draw_text_block(image, {20, 210, 470, 96}, 12, {70, 60, 60}, random);
      break;
  }
  soften(image);
  return image;
}

cv::Mat paint_whiteboard(Random& random) {
  cv::Mat image(420, 640, CV_8UC3, cv::Scalar(240, 241, 240));
  const std::array<cv::Scalar, 3> pens{{{160, 60, 30}, {40, 40, 180}, {50, 50, 50}}};
  for (int i = 0; i < 5; ++i) {
    const cv::Rect box(40 + pick(random, 400), 40 + pick(random, 260), 90 + pick(random, 60), 46);
    cv::rectangle(image, box, pens[random.index(3)], 2, cv::LINE_AA);
    cv::putText(image, random_word(random, 3, 6), {box.x + 8, box.y + 30}, cv::FONT_HERSHEY_SCRIPT_SIMPLEX,
                0.8, pens[random.index(3)], 2, cv::LINE_AA);
    cv::arrowedLine(image, {box.x + box.width, box.y + 20}, {pick(random, 600), pick(random, 380)},
                    pens[random.index(3)], 2, cv::LINE_AA);
  }
  for (int i = 0; i < 3; ++i)
    cv::putText(image, random_word(random, 4, 9) + " = " + random_word(random, 3, 6), {30, 330 + 30 * i},
                cv::FONT_HERSHEY_SCRIPT_SIMPLEX, 0.9, pens[random.index(3)], 2, cv::LINE_AA);
  soften(image);
  return image;
}

cv::Mat paint_notice_board(Random& random) {
  cv::Mat image = paint_fabric({88, 130, 176}, random);
  cv::resize(image, image, {640, 448});
  for (int i = 0; i < 9; ++i) {
    cv::Mat sheet = i % 3 == 2 ? paint_poster(random) : paint_paper(random);
    const int height = 130 + pick(random, 40);
    cv::resize(sheet, sheet, {height * 7 / 10, height}, 0, 0, cv::INTER_AREA);
    const int x = std::min(16 + (i % 5) * 124 + pick(random, 12), image.cols - sheet.cols);
    const int y = 16 + (i / 5) * 212 + pick(random, 40);
    sheet.copyTo(image({x, y, sheet.cols, sheet.rows}));
    cv::circle(image, {x + sheet.cols / 2, y + 8}, 5, random_colour(random, 30, 220), cv::FILLED,
               cv::LINE_AA);
  }
  cv::rectangle(image, {0, 0, 640, 448}, {70, 90, 110}, 12);
  soften(image);
  return image;
}

cv::Mat paint_label(Random& random) {
  cv::Mat image(128, 192, CV_8UC3, random_colour(random, 90, 230));
  cv::rectangle(image, {20, 30, 150, 70}, {240, 240, 240}, cv::FILLED);
  draw_heading(image, {28, 34, 130, 34}, {40, 30, 30}, random);
  draw_text_block(image, {28, 70, 130, 26}, 9, {60, 60, 60}, random);
  soften(image);
  return image;
}

}  // namespace cpslam::sim
