#pragma once

#include <string>

namespace CLI {
class App;
}

namespace cpslam::program {

/// Adds --resolution WxH of a camera. width and height must outlive the parsing.
void add_size_option(CLI::App& app, const std::string& group, int& width, int& height);

}  // namespace cpslam::program
