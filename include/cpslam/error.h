#pragma once

#include <stdexcept>
#include <string>

namespace cpslam {

/// Root of every exception the library throws on purpose. The text is one line that names the file, line or
/// key that is wrong and, where there is one, the way out.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The caller's input is wrong: a file, a setting, an argument, an image. Programs return 2.
class InputError : public Error {
 public:
  using Error::Error;
};

/// Something failed while running: the disk is full, a thread died. Programs return 1.
class RunError : public Error {
 public:
  using Error::Error;
};

}  // namespace cpslam
