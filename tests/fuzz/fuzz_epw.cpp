/// libFuzzer's way into the epw reader (cmake -DBEMCAL_FUZZ=ON with clang).
#include "fuzz/seeds.hpp"
#include "fuzz/targets.hpp"

#include <cstddef>
#include <cstdint>

extern "C" int LLVMFuzzerInitialize(int*, char***) {
    bemcal::fuzz::write_seeds({bemcal::job::small_epw()});
    return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    bemcal::job::try_epw(std::string(reinterpret_cast<const char*>(data), size));
    return 0;
}
