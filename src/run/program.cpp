/// Runs a program to its end, with what it says shown or not.
/// Plain handling of processes, without a source. No time limit. Not by external's: its
/// keeper and session are for programs of a job; scripts of ours end with the terminal.
#include "run/program.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>

namespace bemcal::run {

int code_of_program(std::vector<std::string> words, Said said) {
    std::vector<char*> arguments;
    arguments.reserve(words.size() + 1);
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    for (const int stream : {1, 2})
        if (said == Said::hidden)
            posix_spawn_file_actions_addopen(&actions, stream, "/dev/null", O_WRONLY, 0);
    pid_t child = 0;
    int status = 0;
    const bool runs = posix_spawn(&child, arguments[0], &actions, nullptr,
                                  arguments.data(), environ) == 0;
    posix_spawn_file_actions_destroy(&actions);
    const bool ended = runs && waitpid(child, &status, 0) == child && WIFEXITED(status);
    return ended ? WEXITSTATUS(status) : -1;
}

}  // namespace bemcal::run
