#include "base/error.hpp"
#include "base/random.hpp"
#include "store/item_log.hpp"
#include "support/temporary_folder.hpp"

#include <fstream>

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>

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

/// So many records of a run in a log of its own.
std::string log_of(RunMark run, int first, int last) {
    const test::TemporaryFolder folder;
    ItemLog log(folder.path(), 0, run);
    for (int item = first; item < last; ++item)
        log.append({2, item}, pack(answer_of(item)));
    std::ifstream in(folder / "rank-0.log", std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

TEST(ItemLog, RecordsOfAnotherRunAreRefusedAndNamed) {
    const test::TemporaryFolder folder;
    folder.write("rank-0.log", log_of(11, 0, 5));
    folder.write("rank-7.log", log_of(22, 5, 9));
    const LogContent content = read_logs(folder.path(), 11);
    EXPECT_EQ(content.records.size(), 5U);
    EXPECT_EQ(content.n_foreign, 4);
    EXPECT_EQ(content.n_damaged, 0);
    EXPECT_EQ(content.foreign, std::vector{folder / "rank-7.log"});
    EXPECT_EQ(read_logs(folder.path(), 22).records.size(), 4U);
    EXPECT_EQ(read_logs(folder.path(), 33).records.size(), 0U);
    EXPECT_EQ(read_logs(folder.path()).records.size(), 5U) << "that of most";
}

/// The same items of two runs, cut and put together at random.
TEST(ItemLog, LogsOfTwoRunsMixedInAnyWayGiveOnlyOnesOwn) {
    const std::string mine = log_of(11, 0, 20), other = log_of(22, 0, 20);
    Stream random(5, 0, 0);
    for (int way = 0; way < 50; ++way) {
        const test::TemporaryFolder folder;
        std::string mixed;
        for (int part = 0; part < 6; ++part) {
            const std::string& from = part % 2 == 0 ? mine : other;
            const auto size = static_cast<std::uint32_t>(from.size());
            const std::uint32_t at = random.below(size);
            mixed += from.substr(at, random.below(size - at));
        }
        folder.write("rank-0.log", mixed);
        folder.write("rank-1.log", way % 3 == 0 ? mine : other);
        const LogContent content = read_logs(folder.path(), 11);
        for (const auto& record : content.records)
            EXPECT_EQ(record.packed, pack(answer_of(record.key.item)));
        if (way % 3 == 0) {
            EXPECT_EQ(content.records.size(), 20U) << way;
        }
    }
}

TEST(ItemLog, ALogIsNeverWrittenIntoAgain) {
    const test::TemporaryFolder folder;
    folder.write("victim", "precious");
    std::filesystem::create_symlink("victim", folder / "rank-0.log");
    write_items(folder.path(), 0, 0, 3);
    write_items(folder.path(), 0, 3, 5);
    EXPECT_EQ(std::filesystem::file_size(folder / "victim"), 8U);
    EXPECT_TRUE(std::filesystem::exists(folder / "rank-0-3.log"));
    std::filesystem::remove(folder / "rank-0.log");
    EXPECT_EQ(read_logs(folder.path()).records.size(), 5U);
}

TEST(ItemLog, ALogThatIsAFolderOrAPipeIsAUserError) {
    const test::TemporaryFolder folder;
    std::filesystem::create_directory(folder / "rank-0.log");
    EXPECT_THROW(read_logs(folder.path()), UserError);
    std::filesystem::remove(folder / "rank-0.log");
    ASSERT_EQ(::mkfifo((folder / "rank-0.log").c_str(), 0600), 0);
    EXPECT_THROW(read_logs(folder.path()), UserError);
}

TEST(ItemLog, NoticesWhatOthersDoToIt) {
    const test::TemporaryFolder folder;
    const auto file = folder / "rank-0.log";
    ItemLog log(folder.path(), 0);
    log.append({1, 1}, pack(answer_of(1)));
    EXPECT_EQ(log.trouble(), "");
    std::ofstream(file, std::ios::app) << "x";
    EXPECT_NE(log.trouble().find("was changed"), std::string::npos);
    std::filesystem::resize_file(file, 10);
    EXPECT_NE(log.trouble().find("was changed"), std::string::npos);
    std::filesystem::rename(file, folder / "moved");
    EXPECT_NE(log.trouble().find("was removed"), std::string::npos);
    folder.write("rank-0.log", "of another");
    EXPECT_NE(log.trouble().find("was replaced"), std::string::npos);
}

TEST(ItemLog, ASoundRecordThatHoldsNoAnswerIsDamaged) {
    const test::TemporaryFolder folder;
    ItemLog log(folder.path(), 0);
    log.append({1, 1}, std::vector<std::byte>(8, std::byte{0xff}));
    log.append({1, 2}, pack(answer_of(2)));
    const LogContent content = read_logs(folder.path());
    EXPECT_EQ(content.records.size(), 1U);
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
