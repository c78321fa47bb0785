#include "common/size_option.h"

#include <CLI/CLI.hpp>
#include <cstdio>

namespace cpslam::program {

void add_size_option(CLI::App& app, const std::string& group, int& width, int& height) {
  const auto take = [&width, &height](const std::string& text) {
    char rest = '\0';
    const int read = std::sscanf(text.c_str(), "%5dx%5d%c", &width, &height, &rest);
    if (read != 2 || width < 1 || height < 1)
      throw CLI::ValidationError("--resolution", "'" + text + "' is not of the form 640x480");
  };
  app.add_option_function<std::string>("--resolution", take, "Of the camera's images, px; default 640x480")
      ->type_name("WxH")
      ->group(group);
}

}  // namespace cpslam::program
