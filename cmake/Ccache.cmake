# Use ccache when it is there and the user has not chosen a launcher.
find_program(CPSLAM_CCACHE ccache)
if(CPSLAM_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CPSLAM_CCACHE})
endif()
