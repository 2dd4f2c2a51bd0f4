/// What the command line takes, as plain lists: man pages and completions are made of it.
#pragma once

#include <string>
#include <vector>

namespace bemcal::manual {

struct Option {
    std::vector<std::string> names;  ///< "-o", "--output"; none of a positional one
    std::string value;  ///< "FILE", what it takes, or what stands there; "" of a flag
    std::string sentence;
    bool repeats = false;  ///< may stand in a line several times
};

struct Command {
    std::string name, sentence;
    std::vector<Option> options;
};

struct Program {
    std::string name, version, sentence, footer;
    std::vector<Command> commands;
    std::vector<std::string> topics;  ///< of its command `describe`
};

}  // namespace bemcal::manual
