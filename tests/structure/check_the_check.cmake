# SPDX-FileCopyrightText: 2026 The Bladewright authors
# SPDX-License-Identifier: MIT
#
# The check of the arrows sees what it is there for: a small tree with one slip of each kind. Run: cmake -DWORK=<folder> -P check_the_check.cmake
file(REMOVE_RECURSE ${WORK})
set(house core/include/bw/core)
file(WRITE ${WORK}/rooms.txt "core : ${house} core/src : - : - : -\n  low\n  high\n  empty\nview : viewer : core : qt : -\n")
file(WRITE ${WORK}/docs/architecture.md "`core`, `low`, `high`, `view`")
file(WRITE ${WORK}/${house}/low/a.h "#include \"bw/core/high/b.h\"\n")
file(WRITE ${WORK}/${house}/low/c.h "#include \"bw/core/low/d.h\"\n")
file(WRITE ${WORK}/${house}/low/d.h "#include \"bw/core/low/c.h\"\n")
file(WRITE ${WORK}/${house}/high/b.h "#include <vector>\n")
file(WRITE ${WORK}/core/src/high/b.cpp "#include \"bw/core/high/b.h\"\n#include \"high/own.h\"\n#include <QString>\n#include \"eye.h\"\n")
file(WRITE ${WORK}/core/src/high/own.h "#include \"bw/core/low/c.h\"\n")
file(WRITE ${WORK}/core/src/high/eye.h "#include \"../../../viewer/eye.h\"\n")
file(WRITE ${WORK}/core/src/lost/l.cpp "")
file(WRITE ${WORK}/viewer/eye.h "#include <QString>\n#include \"bw/core/high/b.h\"\n")
execute_process(COMMAND ${CMAKE_COMMAND} -DSOURCE=${WORK} -DROOMS=${WORK}/rooms.txt -P ${CMAKE_CURRENT_LIST_DIR}/check_includes.cmake
                RESULT_VARIABLE status OUTPUT_QUIET ERROR_VARIABLE text)
if(status EQUAL 0)
  message(FATAL_ERROR "a tree full of slips was accepted")
endif()
foreach(slip
    "low/a.h includes bw/core/high/b.h: core/low may not look at core/high"
    "circle of includes among [^\n]*low/c.h [^\n]*low/d.h"
    "b.cpp includes QString: qt is not allowed"
    "eye.h includes ../../../viewer/eye.h: core may not look at view"
    "core/src/lost/l.cpp stands in no room"
    "no file stands in the room core/empty"
    "does not tell what empty is")
  if(NOT text MATCHES "${slip}")
    message(FATAL_ERROR "not seen: ${slip}\n${text}")
  endif()
endforeach()
string(REGEX MATCHALL "\n    +[a-z/]" slips "${text}")
list(LENGTH slips count)
if(NOT count EQUAL 7)
  message(FATAL_ERROR "${count} slips instead of 7: ${text}")
endif()
