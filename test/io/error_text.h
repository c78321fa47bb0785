#pragma once

#include <gtest/gtest.h>

#include <string>

#include "cpslam/error.h"

namespace cpslam {

/// The text of the Exception that `call` must throw; checks that it is one line.
template <typename Exception, typename Call>
std::string error_text(const Call& call) {
  try {
    call();
  } catch (const Exception& error) {
    const std::string text = error.what();
    EXPECT_EQ(text.find('\n'), std::string::npos) << text;
    return text;
  }
  ADD_FAILURE() << "no exception";
  return {};
}

template <typename Call>
std::string input_error(const Call& call) {
  return error_text<InputError>(call);
}

}  // namespace cpslam
