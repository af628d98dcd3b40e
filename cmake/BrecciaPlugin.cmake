# SPDX-License-Identifier: BSD-3-Clause
# breccia_add_plugin(<kind> <name> SOURCES <file>... [LINK <target>...])
#
# One folder, one plugin, one shared library: breccia_<kind>.<name>.so. The program finds it by that name without
# opening it. Links the SDK (headers and the compile options that the step loop needs), never the core.
function(breccia_add_plugin kind name)
  cmake_parse_arguments(PARSE_ARGV 2 P "" "" "SOURCES;LINK")
  set(target breccia_${kind}_${name})
  add_library(${target} MODULE ${P_SOURCES})
  target_link_libraries(${target} PRIVATE Breccia::sdk ${P_LINK})
  if(TARGET breccia_options)
    target_link_libraries(${target} PRIVATE breccia_options)
  endif()
  set(version "${PROJECT_VERSION}")
  if(NOT version)
    set(version "0")
  endif()
  target_compile_definitions(${target} PRIVATE BRECCIA_PLUGIN_VERSION="${version}")
  # nodelete: objects of a plugin may outlive every handle to its library.
  target_link_options(${target} PRIVATE -Wl,-z,nodelete -Wl,-z,defs)
  if(BRECCIA_SANITIZE)
    target_link_options(${target} PRIVATE -Wl,-z,undefs)
  endif()
  set_target_properties(${target} PROPERTIES PREFIX "" OUTPUT_NAME "breccia_${kind}.${name}" SUFFIX ".so"
    CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
  if(TARGET breccia_headers_plugins)
    if("OpenMP::OpenMP_CXX" IN_LIST P_LINK)  # another dialect: headers of its own
      target_precompile_headers(${target} PRIVATE <breccia/contact_law.hpp>)
    else()
      target_precompile_headers(${target} REUSE_FROM breccia_headers_plugins)
    endif()
  endif()
  if(CMAKE_PROJECT_NAME STREQUAL "Breccia")
    set_target_properties(${target} PROPERTIES LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/lib/breccia)
    install(TARGETS ${target} LIBRARY DESTINATION lib/breccia)
  endif()
endfunction()
