/// libFuzzer's way into the tables: datasets of whole results, changed one by one.
#include "fuzz/result_targets.hpp"
#include "job/small_results.hpp"

namespace {

const auto& good_results() {
    static const bemcal::store::ResultFile good[] = {bemcal::job::small_result(),
                                                     bemcal::job::small_stock_result()};
    return good;
}

}  // namespace

/// Makes the good results before a run is timed.
extern "C" int LLVMFuzzerInitialize(int* /*argc*/, char*** /*argv*/) {
    good_results();
    return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    bemcal::fuzz::Choices choices({data, size});
    bemcal::store::ResultFile result = choices.one_of(good_results());
    bemcal::fuzz::damage(result, choices);
    bemcal::fuzz::try_result(result);
    return 0;
}
