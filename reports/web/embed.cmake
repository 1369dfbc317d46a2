# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The Rigor authors
#
# cmake -DOUTPUT=<file.cpp> -DINPUTS=<a;b;...> -P embed.cmake
# Writes a source file that holds the inputs as byte arrays behind webAsset().
set(arrays "")
set(entries "")
set(index 0)
foreach(input IN LISTS INPUTS)
    get_filename_component(name "${input}" NAME)
    file(READ "${input}" hex HEX)
    string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${hex}")
    string(REGEX REPLACE "(0x..,0x..,0x..,0x..,0x..,0x..,0x..,0x..,0x..,0x..,0x..,0x..,0x..,0x..,0x..,0x..,)" "\\1\n"
                         bytes "${bytes}")
    string(APPEND arrays "constexpr unsigned char kFile${index}[] = {\n${bytes}0};\n")
    string(APPEND entries
           "    if (name == \"${name}\") return {reinterpret_cast<const char*>(kFile${index}), sizeof(kFile${index}) - 1};\n")
    math(EXPR index "${index} + 1")
endforeach()
file(WRITE "${OUTPUT}"
"// Written by embed.cmake.
#include \"reports/web_assets.hpp\"

#include <stdexcept>
#include <string>

namespace rigor::report {
namespace {
${arrays}}  // namespace

std::string_view webAsset(std::string_view name) {
${entries}    throw std::out_of_range(\"report: no embedded file \" + std::string(name));
}

}  // namespace rigor::report
")
