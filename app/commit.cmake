# SPDX-License-Identifier: GPL-3.0-or-later
# cmake -DROOT=.. -DOUT=commit.hpp -P commit.cmake: the commit that the sources are of, where git knows it.
set(commit "unknown")
find_program(GIT git)
if(GIT AND EXISTS ${ROOT}/.git)
    execute_process(COMMAND ${GIT} -c safe.directory=* -C ${ROOT} log -1 --format=%H OUTPUT_VARIABLE found
        OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE status)
    if(status EQUAL 0)
        string(SUBSTRING "${found}" 0 12 commit)  # how short git makes it depends on the clone
    endif()
endif()
file(WRITE ${OUT} "/// Made by app/commit.cmake.\n#pragma once\n#define EXTREMAL_COMMIT \"${commit}\"\n")
