/// A folder that goes when the test ends, with files in it.
#pragma once

#include "support/temporary_folder.hpp"

#include <fstream>
#include <sstream>
#include <string>

namespace bemcal::external {

class Folder : public test::TemporaryFolder {
  public:
    std::filesystem::path write(const std::string& name, const std::string& text) const {
        std::ofstream(*this / name) << text;
        return *this / name;
    }
    std::filesystem::path write_program(const std::string& name,
                                        const std::string& text) const {
        const auto file = write(name, text);
        std::filesystem::permissions(file, std::filesystem::perms::owner_all);
        return file;
    }
    std::string text(const std::string& name) const {
        std::ostringstream text;
        text << std::ifstream(*this / name).rdbuf();
        return text.str();
    }
    std::size_t n_files() const {
        std::size_t n = 0;
        for ([[maybe_unused]] const auto& each :
             std::filesystem::directory_iterator(path()))
            ++n;
        return n;
    }
};

}  // namespace bemcal::external
