/// Which step of a building's search is under way, for whoever looks.
#pragma once

#include <atomic>
#include <string>

#include <fmt/format.h>

namespace bemcal::loop {

class UnderWay {
  public:
    explicit UnderWay(std::string building) : building_(std::move(building)) {}

    /// \param what  a literal \param number  from 1; 0 = of a step that comes once
    void begin(const char* what, int number = 0) {
        number_ = number;
        what_ = what;
    }
    /// "office: effect 3"
    std::string text() const {
        const int number = number_;
        return fmt::format("{}: {}{}", building_, what_.load(),
                           number > 0 ? fmt::format(" {}", number) : "");
    }

  private:
    std::string building_;
    std::atomic<const char*> what_ = "reading";
    std::atomic<int> number_ = 0;
};

}  // namespace bemcal::loop
