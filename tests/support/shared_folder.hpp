/// One folder for all ranks, made and removed by rank 0.
#pragma once

#include "support/mpi_world.hpp"
#include "support/temporary_folder.hpp"

#include <cstring>
#include <filesystem>
#include <optional>
#include <string>

namespace bemcal::test {

class SharedFolder {
  public:
    SharedFolder() {
        std::string path;
        if (world().rank() == 0) path = own_.emplace().path();
        run::Bytes bytes(path.size());
        std::memcpy(bytes.data(), path.data(), path.size());
        const run::Bytes shared = world().all_gather(bytes)[0];
        path_ = std::string(reinterpret_cast<const char*>(shared.data()), shared.size());
    }
    ~SharedFolder() { world().barrier(); }
    SharedFolder(const SharedFolder&) = delete;
    SharedFolder& operator=(const SharedFolder&) = delete;
    std::filesystem::path operator/(const char* name) const { return path_ / name; }

  private:
    std::optional<TemporaryFolder> own_;
    std::filesystem::path path_;
};

}  // namespace bemcal::test
