# SPDX-FileCopyrightText: 2026 The Bladewright authors
# SPDX-License-Identifier: MIT
#
# Messages of the libraries are read in the window as well as in a terminal: they speak of things, not of verbs, options
# and keys of the command line. Run: cmake -DSOURCE=<root> -P check_words.cmake

set(failures "")
file(GLOB_RECURSE files
  ${SOURCE}/core/src/base/*.cpp ${SOURCE}/core/src/calibration/*.cpp ${SOURCE}/core/src/fit/*.cpp
  ${SOURCE}/core/src/sweep/*.cpp ${SOURCE}/core/src/design/design.cpp ${SOURCE}/geometry/src/*.cpp
  ${SOURCE}/robotio/src/*.cpp ${SOURCE}/app/pipeline/*.cpp ${SOURCE}/app/model/*.cpp ${SOURCE}/app/bladewright/src/*.cpp
  ${SOURCE}/viewer/*.cpp)
# The window's own options are read in a terminal, and only the command line compares folders with their reports.
list(FILTER files EXCLUDE REGEX "window/options\\.cpp$|bladewright/src/main\\.cpp$|pipeline/src/run_identity\\.cpp$")

set(verbs "rationalize|check|render|export|info|design|fit|bvp|biarc|spline|relax|piecewise|discrete|length|example|sections|verify")
set(words
  "with blade (${verbs})"     # a verb named as a remedy
  "(for|run|use|see|try) blade (${verbs})"
  "blade (${verbs}) --"
  "[^-!<]--[a-z][a-z-]+[^-a-z>]"  # an option
  "\\\\\"auto\\\\\""          # a value of a job key
  "(choose|give|set|use) \\\\\"[a-z_]+\\\\\""
  "(set|use|give) [a-z]+_[a-z_]+")
foreach(file IN LISTS files)
  file(STRINGS ${file} lines REGEX "\"[^\"]*[a-z] [a-z][^\"]*\"|choose|give")
  foreach(line IN LISTS lines)
    if(line MATCHES "^[ \t]*//")
      continue()
    endif()
    foreach(word IN LISTS words)
      if(line MATCHES "${word}")
        file(RELATIVE_PATH short ${SOURCE} ${file})
        string(STRIP "${line}" line)
        string(APPEND failures "\n  ${short}: ${line}")
        break()
      endif()
    endforeach()
  endforeach()
endforeach()

if(failures)
  message(FATAL_ERROR "Words of the command line in messages that the window shows:${failures}")
endif()
