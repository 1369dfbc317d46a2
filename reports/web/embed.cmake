# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The Rigor authors
#
# cmake -DOUTPUT=<file.cpp> -DINPUTS=<a;b;...> -P embed.cmake
# Writes a source file that holds the inputs, which are text, as string literals behind webAsset().
set(literals "")
set(entries "")
set(index 0)
foreach(input IN LISTS INPUTS)
    get_filename_component(name "${input}" NAME)
    file(READ "${input}" content)
    string(FIND "${content}" ")rigor\"" end)
    string(FIND "${content}" "\r" carriage_return)
    if(NOT end EQUAL -1 OR NOT carriage_return EQUAL -1)
        message(FATAL_ERROR "${input} does not fit into a raw string literal")
    endif()
    string(APPEND literals "constexpr char kFile${index}[] = R\"rigor(${content})rigor\";\n")
    string(APPEND entries
           "    if (name == \"${name}\") return {kFile${index}, sizeof(kFile${index}) - 1};\n")
    math(EXPR index "${index} + 1")
endforeach()
file(WRITE "${OUTPUT}"
"// Written by embed.cmake.
#include \"reports/page/web_assets.hpp\"

#include <stdexcept>
#include <string>

namespace rigor::report {
namespace {
${literals}}  // namespace

std::string_view webAsset(std::string_view name) {
${entries}    throw std::out_of_range(\"report: no embedded file \" + std::string(name));
}

}  // namespace rigor::report
")
