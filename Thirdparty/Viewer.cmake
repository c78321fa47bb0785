# What only the viewer needs. AUTO builds it where all of it is found.
set(CPSLAM_VIEWER AUTO CACHE STRING "Build the viewer (--viewer): AUTO, ON or OFF")
set_property(CACHE CPSLAM_VIEWER PROPERTY STRINGS AUTO ON OFF)

set(CPSLAM_HAS_VIEWER OFF)
if(CPSLAM_VIEWER)
  find_package(glfw3 3.3 QUIET)
  find_path(CPSLAM_IMGUI_INCLUDE imgui.h PATH_SUFFIXES imgui)
  find_library(CPSLAM_IMGUI_LIBRARY imgui)
  # Debian's ImGui leaves out its copy of stb.
  find_library(CPSLAM_STB_LIBRARY stb)
  find_path(CPSLAM_EPOXY_INCLUDE epoxy/gl.h)
  find_library(CPSLAM_EPOXY_LIBRARY epoxy)
  mark_as_advanced(CPSLAM_IMGUI_INCLUDE CPSLAM_IMGUI_LIBRARY CPSLAM_STB_LIBRARY CPSLAM_EPOXY_INCLUDE
                   CPSLAM_EPOXY_LIBRARY)
  if(glfw3_FOUND AND CPSLAM_IMGUI_INCLUDE AND CPSLAM_IMGUI_LIBRARY AND CPSLAM_STB_LIBRARY AND CPSLAM_EPOXY_INCLUDE
     AND CPSLAM_EPOXY_LIBRARY)
    set(CPSLAM_HAS_VIEWER ON)
    add_library(cpslam_graphics INTERFACE)
    target_include_directories(cpslam_graphics SYSTEM INTERFACE ${CPSLAM_IMGUI_INCLUDE} ${CPSLAM_EPOXY_INCLUDE})
    target_link_libraries(cpslam_graphics INTERFACE ${CPSLAM_IMGUI_LIBRARY} ${CPSLAM_STB_LIBRARY} glfw
                                                    ${CPSLAM_EPOXY_LIBRARY} ${CMAKE_DL_LIBS})
  elseif(CPSLAM_VIEWER STREQUAL "AUTO")
    message(STATUS "No viewer: it needs libglfw3-dev, libimgui-dev and libepoxy-dev")
  else()
    message(FATAL_ERROR "The viewer needs libglfw3-dev, libimgui-dev and libepoxy-dev; CPSLAM_VIEWER=OFF leaves it out")
  endif()
endif()
