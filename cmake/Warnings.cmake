# One interface target carries the warnings and sanitizers of every target we build.
add_library(cpslam_flags INTERFACE)
target_compile_options(
  cpslam_flags
  INTERFACE -Wall
            -Wextra
            -Wconversion
            -Wshadow
            -Werror
            # sqrt and rint without errno vectorise; no result of ours depends on errno.
            -fno-math-errno)
if(CPSLAM_SANITIZE)
  target_compile_options(cpslam_flags INTERFACE -fsanitize=${CPSLAM_SANITIZE} -fno-omit-frame-pointer)
  target_link_options(cpslam_flags INTERFACE -fsanitize=${CPSLAM_SANITIZE})
endif()
