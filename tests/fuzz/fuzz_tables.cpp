/// libFuzzer's way into the tables: datasets of whole results, changed one by one.
#include "fuzz/result_targets.hpp"
#include "job/small_results.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const bemcal::store::ResultFile good[] = {bemcal::job::small_result(),
                                                     bemcal::job::small_stock_result()};
    bemcal::fuzz::Choices choices({data, size});
    bemcal::store::ResultFile result = choices.one_of(good);
    bemcal::fuzz::damage(result, choices);
    bemcal::fuzz::try_result(result);
    return 0;
}
