# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The Rigor authors
#
# Several files of a target are compiled as one: what they have in common (headers, the precompiled header's pending
# templates, instantiations of the standard library) is done once and not in each. rigor_unity(<target> [<files>])
# lets a target do so, by default 16 files at a time (0: all of them); rigor_unity_by_folder(<target>) compiles all files
# of a folder at once.
#
# Every file stands alone all the same: RIGOR_UNITY=OFF (the debug preset) shows what is forgotten. Names in unnamed
# namespaces must differ within a folder.
option(RIGOR_UNITY "Compile several files of a target at once" ON)

function(rigor_unity target)
    set(files 16)
    if(ARGC GREATER 1)
        set(files ${ARGV1})
    endif()
    set_target_properties(${target} PROPERTIES UNITY_BUILD ${RIGOR_UNITY} UNITY_BUILD_BATCH_SIZE ${files})
    if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
        # GCC takes the files for headers, in which a class with members of an unnamed namespace would be a mistake.
        set(before "#pragma GCC diagnostic ignored \"-Wsubobject-linkage\"")
        set_target_properties(${target} PROPERTIES UNITY_BUILD_CODE_BEFORE_INCLUDE "${before}")
    endif()
endfunction()

function(rigor_unity_by_folder target)
    rigor_unity(${target})
    set_target_properties(${target} PROPERTIES UNITY_BUILD_MODE GROUP)
    get_target_property(sources ${target} SOURCES)
    foreach(source ${sources})
        cmake_path(GET source PARENT_PATH folder)
        cmake_path(RELATIVE_PATH folder BASE_DIRECTORY ${PROJECT_SOURCE_DIR})
        string(REPLACE "/" "_" group ${folder})
        set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${group})
    endforeach()
endfunction()
