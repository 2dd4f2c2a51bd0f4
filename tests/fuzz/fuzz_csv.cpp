/// libFuzzer's way into the csv reader (cmake -DBEMCAL_FUZZ=ON with clang).
#include "fuzz/seeds.hpp"
#include "fuzz/targets.hpp"

#include <cstddef>
#include <cstdint>

extern "C" int LLVMFuzzerInitialize(int*, char***) {
    bemcal::fuzz::write_seeds(
        {bemcal::job::small_readings(72), bemcal::job::small_weather(72)});
    return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    bemcal::job::try_csv(std::string(reinterpret_cast<const char*>(data), size));
    return 0;
}
