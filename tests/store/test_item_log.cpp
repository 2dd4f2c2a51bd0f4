#include "base/error.hpp"
#include "store/item_log.hpp"
#include "support/temporary_folder.hpp"

#include <fstream>

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>

namespace bemcal::store {
namespace {

study::ItemAnswer answer_of(int item) {
    study::ItemAnswer answer;
    answer.values = {item * 1.5, -0.0, 1e300};
    if (item % 3 == 0) answer.failures = {{item * 10LL, "the zone left the method"}};
    return answer;
}

void write_items(const std::filesystem::path& folder, int rank, int first, int last) {
    ItemLog log(folder, rank);
    for (int item = first; item < last; ++item)
        log.append({2, item}, pack(answer_of(item)));
    log.sync();
}

void change_byte(const std::filesystem::path& file, std::streamoff at) {
    std::fstream stream(file, std::ios::binary | std::ios::in | std::ios::out);
    stream.seekg(at);
    const char old = static_cast<char>(stream.get());
    stream.seekp(at);
    stream.put(static_cast<char>(old ^ 0x40));
}

TEST(ItemLog, AnAnswerSurvivesPackingBitForBit) {
    study::ItemAnswer answer = answer_of(3);
    answer.error = "no memory";
    const auto packed = pack(answer);
    const study::ItemAnswer again = unpack(packed.data(), packed.size());
    EXPECT_EQ(again.values, answer.values);
    ASSERT_EQ(again.failures.size(), 1U);
    EXPECT_EQ(again.failures[0].point, 30);
    EXPECT_EQ(again.failures[0].reason, answer.failures[0].reason);
    EXPECT_EQ(again.error, "no memory");
}

TEST(ItemLog, APackedAnswerThatIsCutIsRefused) {
    const auto packed = pack(answer_of(3));
    for (std::size_t bytes = 0; bytes < packed.size(); ++bytes)
        EXPECT_THROW(unpack(packed.data(), bytes), std::logic_error) << bytes;
}

TEST(ItemLog, ReadsTheLogsOfAllRanks) {
    const test::TemporaryFolder folder;
    write_items(folder.path(), 0, 0, 5);
    write_items(folder.path(), 1, 5, 9);
    const LogContent content = read_logs(folder.path());
    EXPECT_EQ(content.n_damaged, 0);
    ASSERT_EQ(content.records.size(), 9U);
    for (const auto& record : content.records) {
        EXPECT_EQ(record.key.stage, 2);
        EXPECT_EQ(record.packed, pack(answer_of(record.key.item)));
    }
}

TEST(ItemLog, AnItemThatStandsTwiceCountsOnce) {
    const test::TemporaryFolder folder;
    write_items(folder.path(), 0, 0, 5);
    write_items(folder.path(), 1, 0, 5);
    EXPECT_EQ(read_logs(folder.path()).records.size(), 5U);
}

TEST(ItemLog, OfSeveralAnswersTheOneWithTheFewestFailuresCounts) {
    study::ItemAnswer failed, some_failed, good;
    failed.error = "no licence";
    some_failed.failures = {{3, "no licence"}};
    good.values = {1.5};
    for (const auto& order : {std::vector{failed, some_failed, good},
                              std::vector{good, failed, some_failed}}) {
        const test::TemporaryFolder folder;
        ItemLog log(folder.path(), 0);
        for (const study::ItemAnswer& answer : order) log.append({1, 7}, pack(answer));
        const LogContent content = read_logs(folder.path());
        ASSERT_EQ(content.records.size(), 1U);
        EXPECT_EQ(content.records[0].packed, pack(good));
    }
}

TEST(ItemLog, AnswersThatStartedFromSomethingElseAreOthers) {
    const test::TemporaryFolder folder;
    ItemLog log(folder.path(), 0);
    log.append({1, 7, 100}, pack(answer_of(1)));
    log.append({1, 7, 200}, pack(answer_of(2)));
    EXPECT_EQ(read_logs(folder.path()).records.size(), 2U);
}

TEST(ItemLog, AChangedByteAnywhereCostsItsRecordOnlyAndIsCounted) {
    const test::TemporaryFolder reference;
    write_items(reference.path(), 0, 0, 6);
    const auto size =
        static_cast<std::streamoff>(std::filesystem::file_size(reference / "rank-0.log"));
    for (std::streamoff at = 0; at < size; ++at) {
        std::filesystem::copy_file(reference / "rank-0.log", reference / "kept");
        change_byte(reference / "rank-0.log", at);
        const LogContent content = read_logs(reference.path());
        EXPECT_EQ(content.records.size(), 5U) << at;
        EXPECT_GE(content.n_damaged, 1) << at;
        std::filesystem::rename(reference / "kept", reference / "rank-0.log");
    }
}

TEST(ItemLog, ARecordCutByACrashDoesNotSpoilWhatIsAppendedLater) {
    const test::TemporaryFolder folder;
    write_items(folder.path(), 0, 0, 4);
    const auto file = folder / "rank-0.log";
    std::filesystem::resize_file(file, std::filesystem::file_size(file) - 7);
    write_items(folder.path(), 0, 4, 6);
    const LogContent content = read_logs(folder.path());
    EXPECT_EQ(content.records.size(), 5U);
    EXPECT_EQ(content.n_damaged, 1);
}

TEST(ItemLog, AFolderThatCannotBeMadeIsAUserError) {
    const test::TemporaryFolder folder;
    std::ofstream(folder / "file") << "x";
    EXPECT_THROW(ItemLog(folder / "file" / "part", 0), UserError);
}

TEST(ItemLog, AFullDiskIsAUserErrorAndKeepsWhatWasWritten) {
    const test::TemporaryFolder folder;
    ::signal(SIGXFSZ, SIG_IGN);
    ItemLog log(folder.path(), 0);
    log.append({0, 0}, pack(answer_of(1)));
    rlimit old{};
    ::getrlimit(RLIMIT_FSIZE, &old);
    const rlimit small{300, old.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &small);
    study::ItemAnswer large;
    large.values.resize(1000);
    EXPECT_THROW(log.append({0, 1}, pack(large)), UserError);
    ::setrlimit(RLIMIT_FSIZE, &old);
    EXPECT_EQ(read_logs(folder.path()).records.size(), 1U);
}

}  // namespace
}  // namespace bemcal::store
