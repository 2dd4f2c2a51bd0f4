/// What a fuzzer of a text starts from: a good one, made here and not kept in a corpus.
#pragma once

#include <cstdlib>
#include <fstream>
#include <initializer_list>
#include <string>

namespace bemcal::fuzz {

/// Into the folder that the environment names, if it does; called before the first input.
inline void write_seeds(std::initializer_list<std::string> texts) {
    const char* folder = std::getenv("BEMCAL_FUZZ_SEEDS");
    int number = 0;
    for (const std::string& text : texts)
        if (folder != nullptr)
            std::ofstream(folder + ("/seed-" + std::to_string(++number)),
                          std::ios::binary)
                << text;
}

}  // namespace bemcal::fuzz
