# SPDX-License-Identifier: GPL-3.0-or-later
# extremal_catalogue(namespace folders type header function)
#   For every FOLDER/<stem>.cpp, which defines `TYPE extremal::NAMESPACE::<stem>()`, one entry in alphabetical order
#   of `const std::vector<TYPE>& extremal::FUNCTION()`. FOLDER may be a pattern, or a list of them. In a folder named
#   tables, a file defines `std::vector<TYPE> extremal::NAMESPACE::<stem>()`, rows without code of their own.
#   Self-registering statics would vanish from a static library.
function(extremal_catalogue namespace folders type header function)
    set(files "")
    foreach(folder ${folders})
        file(GLOB found CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${folder}/*.cpp)
        list(APPEND files ${found})
    endforeach()
    set(stems "")
    set(tables "")
    foreach(file ${files})
        get_filename_component(stem ${file} NAME_WE)
        if(file MATCHES "/tables/[^/]*$")
            list(APPEND tables ${stem})
        else()
            list(APPEND stems ${stem})
        endif()
    endforeach()
    list(SORT stems)
    list(SORT tables)
    set(declarations "")
    set(entries "")
    foreach(stem ${stems})
        string(APPEND declarations "${type} ${stem}();\n")
        string(APPEND entries "        ${namespace}::${stem}(),\n")
    endforeach()
    set(rows "")
    foreach(stem ${tables})
        string(APPEND declarations "std::vector<${type}> ${stem}();\n")
        string(APPEND rows "    addRows(entries, ${namespace}::${stem}());\n")
    endforeach()
    set(out ${CMAKE_CURRENT_BINARY_DIR}/${namespace}_catalogue.cpp)
    file(CONFIGURE OUTPUT ${out} CONTENT
"#include \"engine/core/own_entries.hpp\"
#include \"${header}\"

namespace extremal {
namespace ${namespace} {
${declarations}}  // namespace ${namespace}

const std::vector<${type}>& ${function}() {
    static const std::vector<${type}> all = [] {
        std::vector<${type}> entries{
${entries}        };
${rows}        return OwnEntries<${type}>::joined(std::move(entries));
    }();
    return all;
}
}  // namespace extremal
" @ONLY)
    set(catalogue_sources ${catalogue_sources} ${out} PARENT_SCOPE)
endfunction()

# extremal_families(folder)
#   For every FOLDER/<stem>/family.cpp, which defines `Family extremal::family::<stem>()`, one entry in alphabetical
#   order of `const std::vector<Family>& extremal::families()`.
function(extremal_families folder)
    file(GLOB files CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${folder}/*/family.cpp)
    set(declarations "")
    set(entries "")
    foreach(file ${files})
        get_filename_component(stem ${file} DIRECTORY)
        get_filename_component(stem ${stem} NAME)
        string(APPEND declarations "Family ${stem}();\n")
        string(APPEND entries "        family::${stem}(),\n")
    endforeach()
    set(out ${CMAKE_CURRENT_BINARY_DIR}/families_catalogue.cpp)
    file(CONFIGURE OUTPUT ${out} CONTENT
"#include \"engine/family/family.hpp\"

namespace extremal {
namespace family {
${declarations}}  // namespace family

const std::vector<Family>& families() {
    static const std::vector<Family> all = {
${entries}    };
    return all;
}
}  // namespace extremal
" @ONLY)
    set(catalogue_sources ${catalogue_sources} ${out} PARENT_SCOPE)
endfunction()

# extremal_presets(name folder): compiles FOLDER/*.json (but not a schema) into `extremal::NAME()`.
function(extremal_presets name folder)
    file(GLOB files CONFIGURE_DEPENDS ${folder}/*.json)
    set(entries "")
    foreach(file ${files})
        get_filename_component(stem ${file} NAME_WLE)
        if(NOT stem MATCHES "\\.schema$")
            file(READ ${file} text)
            set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
            string(APPEND entries "        {\"${stem}\", R\"~~~(${text})~~~\"},\n")
        endif()
    endforeach()
    set(out ${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp)
    file(WRITE ${out}.new
"#include \"engine/scene/preset.hpp\"

namespace extremal {
const std::vector<Preset>& ${name}() {
    static const std::vector<Preset> all = {
${entries}    };
    return all;
}
}  // namespace extremal
")
    file(COPY_FILE ${out}.new ${out} ONLY_IF_DIFFERENT)
    set(catalogue_sources ${catalogue_sources} ${out} PARENT_SCOPE)
endfunction()
