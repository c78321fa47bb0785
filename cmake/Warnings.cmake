# One interface target carries the warnings and sanitizers of every target we build.

# An error with the compiler that continuous integration has. Others warn of more, some of it wrong (GCC 14: of
# std::vector's own code), and that must not keep anybody from building.
set(warnings_as_errors OFF)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  set(warnings_as_errors ON)
endif()
option(CPSLAM_WARNINGS_AS_ERRORS "Stop at a warning" ${warnings_as_errors})

add_library(cpslam_flags INTERFACE)
target_compile_options(
  cpslam_flags
  INTERFACE -Wall
            -Wextra
            -Wconversion
            -Wshadow
            $<$<BOOL:${CPSLAM_WARNINGS_AS_ERRORS}>:-Werror>
            # sqrt and rint without errno vectorise; no result of ours depends on errno.
            -fno-math-errno)
if(CPSLAM_SANITIZE)
  target_compile_options(cpslam_flags INTERFACE -fsanitize=${CPSLAM_SANITIZE} -fno-omit-frame-pointer)
  target_link_options(cpslam_flags INTERFACE -fsanitize=${CPSLAM_SANITIZE})
endif()
