/// libFuzzer's way into a result file: bytes of a good one, changed. HDF5 reads it in a
/// process of its own, as it does for every reader.
#include "fuzz/result_targets.hpp"
#include "store/result_file.hpp"
#include "support/temporary_folder.hpp"

#include <fstream>
#include <iterator>
#include <string>

#include <sys/mman.h>
#include <unistd.h>

namespace {

using bemcal::study::Dataset;

Dataset texts(const std::string& path, const std::string& dim,
              std::vector<std::string> values) {
    const std::size_t n = values.size();
    return {path, {dim}, {n}, {}, std::move(values)};
}

std::string good_bytes() {
    bemcal::store::ResultFile result;
    result.attributes = {{"program", "bemcal-batch"}, {"title", "small"}};
    result.run = {{"host", "here"}};
    const std::string study = "house/sensitivity/";
    result.datasets = {
        texts(study + "output", "output", {"heating", "cooling"}),
        texts(study + "output_unit", "output", {"kWh", "kWh"}),
        texts(study + "parameter", "parameter", {"wall", "roof", "leaks"}),
        texts(study + "parameter_unit", "parameter", {"-", "-", "1/h"}),
        {study + "parameter_least", {"parameter"}, {3}, {0, 0, 0}, {}},
        {study + "parameter_most", {"parameter"}, {3}, {1, 1, 1}, {}},
        {study + "total_order", {"output", "parameter"}, {2, 3}, {1, 2, 3, 4, 5, 6}, {}},
        {"house/posterior/posterior/leaks", {"chain", "draw"}, {1, 2}, {1, 2}, {}, "1/h"},
        texts("house/posterior/unknown", "unknown", {"leaks"}),
        texts("stock/stock_building", "stock_building", {"one", "two"})};
    const bemcal::test::TemporaryFolder folder;
    bemcal::store::write_result(folder / "a.h5", result);
    std::ifstream in(folder / "a.h5", std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

/// A file in memory, and its name.
class MemoryFile {
  public:
    explicit MemoryFile(const std::string& bytes) : file_(::memfd_create("result", 0)) {
        if (::write(file_, bytes.data(), bytes.size()) < 0) ::abort();
    }
    ~MemoryFile() { ::close(file_); }
    MemoryFile(const MemoryFile&) = delete;
    MemoryFile& operator=(const MemoryFile&) = delete;
    std::string name() const { return "/proc/self/fd/" + std::to_string(file_); }

  private:
    int file_;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const std::string good = good_bytes();
    bemcal::fuzz::Choices choices({data, size});
    std::string bytes = good;
    if (choices.below(16) == 1) bytes.resize(choices.below(bytes.size()));
    for (auto n = 1 + choices.below(12); n > 0 && !bytes.empty(); --n) {
        char& changed = choices.one_of(bytes);
        changed = static_cast<char>(choices.byte());
    }
    const MemoryFile file(bytes);
    bemcal::fuzz::refusal_of(
        [&] { bemcal::fuzz::try_result(bemcal::store::read_result(file.name())); });
    return 0;
}
