# SPDX-License-Identifier: GPL-3.0-or-later
# The length of functions, as a function of the tree's root:
#
#     extremal_function_violations(ROOT PATH MOST OUT)    OUT: "PATH:LINE: WHAT" of each function of more than MOST lines
#
# A heuristic over formatted sources: a function ends with a line "}" at the margin and begins with the line at the
# margin before it; in a class both are at the first indentation. Texts over several lines that reach the margin hide
# what is before them.
function(extremal_function_violations root path most out)
    set(violations "")
    file(READ ${root}/${path} text)
    # Neither semicolons nor brackets may reach CMake's lists.
    string(REGEX REPLACE "[][;\\]" "_" text "${text}")
    string(REPLACE "\n" ";" lines "${text}")
    set(number 0)
    set(start 0)
    set(inner 0)
    set(margin "")
    foreach(line IN LISTS lines)
        math(EXPR number "${number} + 1")
        if(line MATCHES "^ *(//|#|$)")
            continue()
        endif()
        if(line MATCHES "^[^ ]")
            math(EXPR count "${number} - ${start} + 1")
            if(line STREQUAL "}" AND count GREATER most AND
                    NOT margin MATCHES "^(}|namespace|class|struct|union|enum|extern)")
                list(APPEND violations "${path}:${start}: a function of ${count} lines: more than ${most}")
            endif()
            set(start ${number})
            set(inner ${number})
            set(margin "${line}")
        elseif(line MATCHES "^    [^ ]" AND
                margin MATCHES "^(class|struct|union|template|public:|private:|protected:|signals:)")
            math(EXPR count "${number} - ${inner} + 1")
            if(NOT line STREQUAL "    }")
                set(inner ${number})
            elseif(count GREATER most)
                list(APPEND violations "${path}:${inner}: a function of ${count} lines: more than ${most}")
            endif()
        endif()
    endforeach()
    set(${out} "${violations}" PARENT_SCOPE)
endfunction()
