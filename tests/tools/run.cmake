# SPDX-License-Identifier: GPL-3.0-or-later
# run(command...): runs it in OUT; what it prints is in `said`, what it complains of in `error`. Anything but success is an
# error.
function(run)
    execute_process(COMMAND ${ARGV} WORKING_DIRECTORY ${OUT} RESULT_VARIABLE status OUTPUT_VARIABLE said ERROR_VARIABLE error)
    if(NOT status EQUAL 0)
        message(FATAL_ERROR "${ARGV}: ${status}\n${said}${error}")
    endif()
    set(said "${said}" PARENT_SCOPE)
    set(error "${error}" PARENT_SCOPE)
endfunction()
