# SPDX-FileCopyrightText: 2026 The Bladewright authors
# SPDX-License-Identifier: MIT
#
# Rules that every target of the project shares.

set(BW_WARNINGS -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual
                -Wimplicit-fallthrough)

# bw_target_defaults(<target>): warnings, floating-point rules, hardening and sanitizers.
function(bw_target_defaults target)
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_compile_options(${target} PRIVATE ${BW_WARNINGS} -ffp-contract=off)
  if(BW_WERROR)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
  if(BW_HARDEN)
    # What reads files of strangers ends at the first step out of bounds instead of going on with it; -U first,
    # because some distributions define the macro themselves. Paths of the machine that built stay out.
    target_compile_options(${target} PRIVATE -U_FORTIFY_SOURCE -D_FORTIFY_SOURCE=2 -D_GLIBCXX_ASSERTIONS
                                             -fstack-protector-strong -ffile-prefix-map=${PROJECT_SOURCE_DIR}=.)
    target_link_options(${target} PRIVATE LINKER:-z,relro,-z,now)
  endif()
  if(BW_SANITIZE)
    # What the sanitizers put between loses track of what was set: g++ then warns of moved optionals.
    target_compile_options(${target} PRIVATE -fsanitize=${BW_SANITIZE} -fno-omit-frame-pointer
                                             -fno-sanitize-recover=undefined -Wno-maybe-uninitialized)
    target_link_options(${target} PUBLIC -fsanitize=${BW_SANITIZE})
  endif()
endfunction()

# bw_precompile(<target> <headers…>): headers that most of its files need are parsed once. Presets without it (core, the sanitizers) hold
# each file to what it includes itself.
function(bw_precompile target)
  if(BW_PRECOMPILE)
    target_precompile_headers(${target} PRIVATE <Eigen/Dense> <algorithm> <cmath> <functional> <map> <memory> <optional> <string> <variant> <vector>
                              ${ARGN})
    # Of precompiled headers the compiler forgets that they are the system's, and warns of what it makes of their insides.
    target_compile_options(${target} PRIVATE -Wno-array-bounds -Wno-restrict -Wno-stringop-overflow -Wno-stringop-overread)
  endif()
endfunction()

# bw_unity(<target>): four files at a time are compiled as one, because what they include costs more than they do. For targets of many
# files that name few things alike; presets without it (release, core, the sanitizers) compile each alone.
function(bw_unity target)
  if(BW_UNITY)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 4)
    # Such a file is included, and what it alone knows is then taken for a header's.
    target_compile_options(${target} PRIVATE -Wno-subobject-linkage)
  endif()
endfunction()

# bw_library(<target> INCLUDE_ROOT <dir> HEADERS <files…> SOURCES <files…>): a static module library
# whose only include root is INCLUDE_ROOT. Its headers form a verified header set, so that each compiles alone.
function(bw_library target)
  cmake_parse_arguments(arg "" "INCLUDE_ROOT" "HEADERS;SOURCES" ${ARGN})
  add_library(${target} STATIC ${arg_SOURCES})
  target_sources(${target} PUBLIC FILE_SET HEADERS BASE_DIRS ${arg_INCLUDE_ROOT} FILES ${arg_HEADERS})
  bw_target_defaults(${target})
endfunction()

# bw_executable(<target> SOURCES <files…>): a program or a test program.
function(bw_executable target)
  cmake_parse_arguments(arg "" "" "SOURCES" ${ARGN})
  add_executable(${target} ${arg_SOURCES})
  bw_target_defaults(${target})
endfunction()

# bw_system_includes(<target> <dirs…>): heavy third-party include folders, private and without warnings.
function(bw_system_includes target)
  target_include_directories(${target} SYSTEM PRIVATE ${ARGN})
endfunction()
