# Dear ImGui with its GLFW and OpenGL 3 backends, as ImGui::ImGui. A config package (vcpkg) is preferred; Debian's library has none.
find_package(imgui CONFIG QUIET)
if(TARGET imgui::imgui)
  add_library(ImGui::ImGui ALIAS imgui::imgui)
  set(ImGui_FOUND TRUE)
  return()
endif()
find_path(ImGui_INCLUDE_DIR imgui.h PATH_SUFFIXES imgui)
find_path(ImGui_BACKENDS_DIR imgui_impl_opengl3.h PATH_SUFFIXES imgui/backends)
find_path(ImGui_STB_INCLUDE_DIR stb_image_write.h PATH_SUFFIXES stb)
find_library(ImGui_LIBRARY imgui)
find_library(ImGui_STB_LIBRARY stb)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(ImGui REQUIRED_VARS ImGui_LIBRARY ImGui_STB_LIBRARY ImGui_INCLUDE_DIR ImGui_BACKENDS_DIR ImGui_STB_INCLUDE_DIR)
if(ImGui_FOUND AND NOT TARGET ImGui::ImGui)
  add_library(ImGui::ImGui UNKNOWN IMPORTED)
  set_target_properties(ImGui::ImGui PROPERTIES
    IMPORTED_LOCATION "${ImGui_LIBRARY}"
    INTERFACE_INCLUDE_DIRECTORIES "${ImGui_INCLUDE_DIR};${ImGui_BACKENDS_DIR};${ImGui_STB_INCLUDE_DIR}"
    INTERFACE_LINK_LIBRARIES "${ImGui_STB_LIBRARY};${CMAKE_DL_LIBS}")
endif()
mark_as_advanced(ImGui_INCLUDE_DIR ImGui_BACKENDS_DIR ImGui_LIBRARY ImGui_STB_LIBRARY)
