# A room is one folder of src/: a static library that its tests and the programs link, and whose objects end up in
# the one library that find_package(cpslam) users link.
#
#   cpslam_add_room(<name> SOURCES <files...> [DEPENDS <rooms...>] [LIBRARIES <targets...>] [PRIVATE_ROOM])
#
# DEPENDS names rooms further down the list in docs/architecture.md. PRIVATE_ROOM keeps a room out of the installed
# library (the simulator).
function(cpslam_add_room name)
  cmake_parse_arguments(ARG "PRIVATE_ROOM" "" "SOURCES;DEPENDS;LIBRARIES" ${ARGN})
  add_library(cpslam_${name} STATIC ${ARG_SOURCES})
  target_include_directories(cpslam_${name} PUBLIC ${PROJECT_SOURCE_DIR}/src ${PROJECT_SOURCE_DIR}/include)
  target_link_libraries(cpslam_${name} PUBLIC ${ARG_LIBRARIES} PRIVATE cpslam_flags)
  foreach(room IN LISTS ARG_DEPENDS)
    target_link_libraries(cpslam_${name} PUBLIC cpslam_${room})
  endforeach()
  if(NOT ARG_PRIVATE_ROOM)
    set_property(GLOBAL APPEND PROPERTY CPSLAM_ROOMS cpslam_${name})
    set_property(GLOBAL APPEND PROPERTY CPSLAM_ROOM_LIBRARIES ${ARG_LIBRARIES})
  endif()
endfunction()

# cpslam_add_test(<room> SOURCES <files...> [DEPENDS <rooms...>] [LABELS <label>]): one GoogleTest program,
# test_<room>.
function(cpslam_add_test name)
  cmake_parse_arguments(ARG "" "LABELS" "SOURCES;DEPENDS" ${ARGN})
  set(labels)
  if(ARG_LABELS)
    set(labels LABELS ${ARG_LABELS})
  endif()
  add_executable(test_${name} ${ARG_SOURCES})
  target_include_directories(test_${name} PRIVATE ${PROJECT_SOURCE_DIR}/test)
  target_link_libraries(test_${name} PRIVATE cpslam_flags GTest::gmock GTest::gtest GTest::gtest_main)
  foreach(room IN LISTS ARG_DEPENDS)
    target_link_libraries(test_${name} PRIVATE cpslam_${room})
  endforeach()
  gtest_discover_tests(test_${name} DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT 600 ${labels})
endfunction()

# cpslam_add_program(<name> SOURCES <files...> DEPENDS <rooms...> LIBRARIES <targets...>): an installed program.
function(cpslam_add_program name)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPENDS;LIBRARIES" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE ${ARG_LIBRARIES} cpslam_flags)
  target_compile_definitions(${name} PRIVATE CPSLAM_VERSION="${PROJECT_VERSION}")
  foreach(room IN LISTS ARG_DEPENDS)
    target_link_libraries(${name} PRIVATE cpslam_${room})
  endforeach()
  install(TARGETS ${name} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endfunction()

# cpslam_bundle(<folder> <patterns...>): files of a folder of the source tree that come with the programs. In the build
# tree they are found through a link beside the programs, installed they lie in share/cpslam (io/bundled_file.h).
function(cpslam_bundle folder)
  set(patterns)
  foreach(pattern IN LISTS ARGN)
    list(APPEND patterns PATTERN ${pattern})
  endforeach()
  file(MAKE_DIRECTORY ${CMAKE_RUNTIME_OUTPUT_DIRECTORY})
  file(CREATE_LINK ${PROJECT_SOURCE_DIR}/${folder} ${CMAKE_RUNTIME_OUTPUT_DIRECTORY}/${folder} SYMBOLIC)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/${folder} DESTINATION ${CMAKE_INSTALL_DATADIR}/cpslam OPTIONAL
          FILES_MATCHING ${patterns})
endfunction()
