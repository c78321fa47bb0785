# How each outside dependency is found; Thirdparty/README.md gives package, version, licence and reason.
find_package(Threads REQUIRED)
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(OpenCV 4.5 REQUIRED COMPONENTS core imgproc imgcodecs features2d calib3d dnn)
find_package(Ceres 2.1 REQUIRED COMPONENTS SuiteSparse)
find_package(CLI11 REQUIRED)
find_package(nlohmann_json 3.10 REQUIRED)
# Only the live camera needs it: without, everything else is built.
list(APPEND CMAKE_MODULE_PATH ${CMAKE_CURRENT_LIST_DIR})
find_package(OpenNI2)
# Only the files of the dense map's free and occupied space need it: without, they are refused.
find_package(OCTOMAP QUIET)
if(CPSLAM_BUILD_TESTS)
  find_package(GTest REQUIRED)
  include(GoogleTest)
endif()
if(CPSLAM_BUILD_BENCHMARKS)
  find_package(benchmark REQUIRED)
endif()
