// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The Rigor authors
//
// Command lines of KEY=VALUE words, for the programs that measure over many cases.
#pragma once

#include <initializer_list>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace rigor::engine {

using Arguments = std::map<std::string, std::string>;

/// The words of a list with commas between.
inline std::vector<std::string> split(const std::string& list) {
    std::vector<std::string> words;
    std::istringstream stream(list);
    for (std::string word; std::getline(stream, word, ',');) words.push_back(word);
    return words;
}

/// `all`, keys with their defaults, with the values of the command line. Throws std::invalid_argument for a word
/// that is none of them.
inline Arguments parseArguments(int argc, char** argv, Arguments all) {
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        const std::size_t sign = word.find('=');
        if (sign == std::string::npos || !all.contains(word.substr(0, sign)))
            throw std::invalid_argument("not a known KEY=VALUE: " + word);
        all[word.substr(0, sign)] = word.substr(sign + 1);
    }
    return all;
}

/// The choice whose number is the place of the word among the names. Throws std::invalid_argument.
template <class Choice>
Choice choose(const std::string& word, std::initializer_list<const char*> names) {
    int place = 0;
    for (const char* name : names) {
        if (word == name) return static_cast<Choice>(place);
        ++place;
    }
    throw std::invalid_argument("not known: " + word);
}

}  // namespace rigor::engine
