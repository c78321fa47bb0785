#pragma once

#include <opencv2/core.hpp>

#include "util/random.h"

/// Pictures for the surfaces of a room, painted by program (CV_8UC3, B, G, R). All are band-limited: their
/// finest detail is a pixel or more wide.
namespace cpslam::sim {

// Large surfaces, tileable, nearly uniform as in real rooms.
[[nodiscard]] cv::Mat paint_wall(const cv::Scalar& bgr, Random& random);
[[nodiscard]] cv::Mat paint_carpet(const cv::Scalar& bgr, Random& random);
[[nodiscard]] cv::Mat paint_floor_tiles(const cv::Scalar& bgr, Random& random);
[[nodiscard]] cv::Mat paint_floor_planks(const cv::Scalar& bgr, Random& random);
[[nodiscard]] cv::Mat paint_ceiling(Random& random);
[[nodiscard]] cv::Mat paint_wood(const cv::Scalar& bgr, Random& random);
[[nodiscard]] cv::Mat paint_fabric(const cv::Scalar& bgr, Random& random);
[[nodiscard]] cv::Mat paint_rug(Random& random);

// Printed and drawn things.
[[nodiscard]] cv::Mat paint_poster(Random& random);
[[nodiscard]] cv::Mat paint_paper(Random& random);
[[nodiscard]] cv::Mat paint_book_spine(Random& random);
[[nodiscard]] cv::Mat paint_book_cover(Random& random);
[[nodiscard]] cv::Mat paint_screen(Random& random);
[[nodiscard]] cv::Mat paint_whiteboard(Random& random);
[[nodiscard]] cv::Mat paint_notice_board(Random& random);
[[nodiscard]] cv::Mat paint_label(Random& random);

// Fittings.
[[nodiscard]] cv::Mat paint_door(Random& random);
[[nodiscard]] cv::Mat paint_window_view(Random& random);
[[nodiscard]] cv::Mat paint_keyboard(Random& random);
[[nodiscard]] cv::Mat paint_drawers(const cv::Scalar& bgr, int n_drawers, Random& random);
[[nodiscard]] cv::Mat paint_radiator();
[[nodiscard]] cv::Mat paint_clock();
[[nodiscard]] cv::Mat paint_mug(Random& random);

// People: u runs around the body from the back, v from top to bottom.
[[nodiscard]] cv::Mat paint_shirt(Random& random);
[[nodiscard]] cv::Mat paint_trousers(Random& random);
[[nodiscard]] cv::Mat paint_head(const cv::Scalar& skin_bgr, Random& random);
[[nodiscard]] cv::Mat paint_skin(const cv::Scalar& skin_bgr, Random& random);

/// Smooth random field with features of about cell_px, values about [-1, 1], tileable: CV_32FC1.
[[nodiscard]] cv::Mat smooth_field(cv::Size size, int cell_px, Random& random);
/// base plus amplitude (grey levels) times field, on all channels.
[[nodiscard]] cv::Mat shaded(const cv::Scalar& base_bgr, const cv::Mat& field, double amplitude);
[[nodiscard]] cv::Scalar random_colour(Random& random, double darkest, double brightest);
/// Lines of made-up words, as printed text.
void draw_text_block(cv::Mat& image, const cv::Rect& area, double letter_px, const cv::Scalar& ink,
                     Random& random);
[[nodiscard]] std::string random_word(Random& random, std::size_t shortest, std::size_t longest);

}  // namespace cpslam::sim
