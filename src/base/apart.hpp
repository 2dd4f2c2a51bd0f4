/// Work in a process of its own, so that a crash in it, a loop without an end or a hunger
/// for memory is an answer and not our end.
///
/// For libraries that a damaged file may crash. The process has our memory as it was,
/// writes to a pipe, says nothing, opens no core file and ends with us.
#pragma once

#include <cstddef>
#include <cstdio>
#include <functional>
#include <string>

namespace bemcal {

class Apart {
  public:
    struct Limits {
        double processor_s = 10;
        std::size_t memory = std::size_t{1} << 30;  ///< beyond ours [bytes]
    };

    /// Throws std::system_error where no process can be started.
    /// \param work  is given the stream to write to
    Apart(const std::function<void(std::FILE*)>& work, const Limits& limits);
    ~Apart();  ///< ends it
    Apart(const Apart&) = delete;
    Apart& operator=(const Apart&) = delete;

    std::FILE* answer() const { return answer_; }
    /// Reads no more and waits for it. \return "" where it came to its end, else why it
    /// did not
    std::string ending();

  private:
    int id_ = -1;  ///< -1 = waited for
    std::FILE* answer_ = nullptr;
    std::string ending_;
};

}  // namespace bemcal
