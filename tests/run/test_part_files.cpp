#include "base/disk.hpp"
#include "base/error.hpp"
#include "run/output_place.hpp"
#include "run/part_files.hpp"
#include "store/result_file.hpp"
#include "support/temporary_folder.hpp"

#include <gtest/gtest.h>

namespace bemcal::run {
namespace {

namespace fs = std::filesystem;

const Identity identity{
    {"version", "1"}, {"file meter.csv", "abc"}, {"stage a", "9 items"}};

class Part : public ::testing::Test {
  protected:
    fs::path output() const { return folder_ / "o.h5"; }
    fs::path part() const { return folder_ / "o.h5.part"; }
    void put(const std::string& name, const std::string& text) const {
        fs::create_directories(part());
        folder_.write("o.h5.part/" + name, text);
    }
    std::string text(const std::string& name) const {
        return read_regular(part() / name);
    }
    void append(int first, int last, const Identity& of = identity) const {
        store::ItemLog log(part(), 0, mark_of(of));
        for (int item = first; item < last; ++item) {
            study::ItemAnswer answer;
            answer.values = {1.0 * item};
            log.append({0, item}, store::pack(answer));
        }
    }
    /// A run that was killed after nine items.
    void leave_run() const {
        fs::create_directories(part());
        write_identity(part(), identity);
        append(0, 9);
    }
    std::string refusal(Existing existing, const Identity& now = identity) const {
        try {
            prepare_output(output(), existing, now);
        } catch (const UserError& error) {
            EXPECT_EQ(error.exit_code(), ExitCode::cannot_create) << error.what();
            return error.what();
        }
        return {};
    }
    void expect_refused(Existing existing, const std::string& words) const {
        const std::string said = refusal(existing);
        EXPECT_NE(said.find(words), std::string::npos) << said;
    }
    /// Changes one byte.
    void damage(const std::string& name, std::size_t at) const {
        std::string bytes = text(name);
        bytes.at(at) = static_cast<char>(bytes.at(at) ^ 1);
        put(name, bytes);
    }

    test::TemporaryFolder folder_;
};

TEST_F(Part, AFolderOfSomebodyElseIsLeftAsItIs) {
    put("thesis.txt", "mine");
    for (const Existing existing :
         {Existing::refuse, Existing::force, Existing::resume, Existing::rerun_failed})
        expect_refused(existing, "holds what no run made (thesis.txt)");
    EXPECT_EQ(text("thesis.txt"), "mine");
    EXPECT_EQ(part_files(part()).foreign.size(), 1U);
    EXPECT_FALSE(fs::exists(part() / lock_name));
}

TEST_F(Part, FilesThatOnlyHaveARunsNameAreSomebodyElses) {
    put("identity.txt", "I am what I am\n");
    put("rank-0.log", "a ship's log");
    fs::create_directory(part() / "rank-1.log");
    fs::create_symlink("thesis.txt", part() / "rank-2.log");
    EXPECT_EQ(part_files(part()).foreign.size(), 4U);
    expect_refused(Existing::force, "holds what no run made");
    EXPECT_EQ(text("rank-0.log"), "a ship's log");
}

TEST_F(Part, BesideARunsFilesThoseOfOthersStay) {
    leave_run();
    put("thesis.txt", "mine");
    EXPECT_EQ(remove_part_files(part()), std::vector<std::string>());
    EXPECT_EQ(text("thesis.txt"), "mine");
    EXPECT_TRUE(part_files(part()).ours.empty());
}

TEST_F(Part, WhatAKilledWriterLeftIsARuns) {
    put("result.a1b2c3", "half");
    put("identity.txt.zzzzzz", "version");
    put("rank-0.log", "");
    EXPECT_TRUE(part_files(part()).foreign.empty());
    EXPECT_EQ(refusal(Existing::force), "");
}

TEST_F(Part, ALinkOrAFileIsNoFolder) {
    fs::create_directory(folder_ / "elsewhere");
    fs::create_directory_symlink("elsewhere", part());
    expect_refused(Existing::force, "is a link");
    fs::remove(part());
    folder_.write("o.h5.part", "mine");
    expect_refused(Existing::force, "cannot create the folder");
}

TEST_F(Part, OneRunAtATime) {
    const OutputPlace first = prepare_output(output(), Existing::refuse, identity);
    expect_refused(Existing::resume, "another run is writing there now");
    EXPECT_TRUE(is_running(part()));
}

TEST_F(Part, TheFolderGoesWithTheLastThatIsInIt) {
    prepare_output(output(), Existing::refuse, identity);
    EXPECT_TRUE(fs::exists(part())) << "it holds an identity";
    remove_part_files(part());
    {
        const PartLock lock(part());
    }
    EXPECT_FALSE(fs::exists(part()));
}

TEST_F(Part, ResumesWithWhatIsThere) {
    leave_run();
    expect_refused(Existing::refuse, "holds an unfinished run");
    const OutputPlace place = prepare_output(output(), Existing::resume, identity);
    EXPECT_EQ(place.logs.records.size(), 9U);
    EXPECT_TRUE(place.remarks.empty());
}

TEST_F(Part, RecordsOfAnotherRunAreRefusedAndItsLogIsKept) {
    leave_run();
    append(0, 5, {{"version", "1"}, {"file meter.csv", "other"}});
    const OutputPlace place = prepare_output(output(), Existing::resume, identity);
    EXPECT_EQ(place.logs.records.size(), 9U);
    ASSERT_EQ(place.remarks.size(), 1U);
    EXPECT_NE(place.remarks[0].find("refused: 5 records of another run, in rank-0-2.log"),
              std::string::npos)
        << place.remarks[0];
    remove_part_files(part(), place.logs.foreign);
    EXPECT_EQ(part_files(part()).ours, std::vector{part() / "rank-0-2.log"});
}

TEST_F(Part, WithoutItsIdentityTheRecordsTellWhoseTheyAre) {
    leave_run();
    fs::remove(part() / identity_name);
    expect_refused(Existing::refuse, "holds an unfinished run");
    EXPECT_NE(refusal(Existing::resume, {{"version", "1"}, {"file meter.csv", "other"}})
                  .find("no record in the logs is this job's"),
              std::string::npos);
    EXPECT_EQ(prepare_output(output(), Existing::resume, identity).logs.records.size(),
              9U);
    EXPECT_TRUE(has_identity(part(), identity));
}

TEST_F(Part, AnIdentityThatIsAFolderIsNamedAndNothingIsLost) {
    leave_run();
    fs::remove(part() / identity_name);
    fs::create_directory(part() / identity_name);
    try {
        prepare_output(output(), Existing::resume, identity);
        ADD_FAILURE() << "not refused";
    } catch (const UserError& error) {
        EXPECT_EQ(error.exit_code(), ExitCode::data);
        EXPECT_EQ(error.what(),
                  (part() / identity_name).string() + ": is a folder; expected a file");
    }
    fs::remove(part() / identity_name);
    EXPECT_EQ(prepare_output(output(), Existing::resume, identity).logs.records.size(),
              9U);
}

TEST_F(Part, DamageAtAnyPlaceOfTheIdentityLosesNothingAndIsSaid) {
    leave_run();
    const std::string whole = text(identity_name);
    for (std::size_t at = 0; at < whole.size(); ++at) {
        damage(identity_name, at);
        EXPECT_THROW(part_status(part()), UserError) << at;
        const std::string said = refusal(Existing::resume);
        if (said.empty()) {
            EXPECT_EQ(text(identity_name), whole) << at;
        } else {
            EXPECT_NE(said.find("is damaged, or was changed"), std::string::npos) << at;
            EXPECT_LE(at, whole.find('\n')) << "only another version is refused";
        }
        put(identity_name, whole);
    }
}

TEST_F(Part, OtherDataAreNamed) {
    leave_run();
    const std::string said =
        refusal(Existing::resume, {{"version", "1"}, {"file meter.csv", "other"}});
    EXPECT_NE(said.find("meter.csv has changed since"), std::string::npos) << said;
}

TEST_F(Part, ADamagedResultIsNotTakenForDone) {
    store::ResultFile result;
    result.attributes = {{"program", "bemcal-batch"}, {"identity", hash_of(identity)}};
    store::write_result(output(), result);
    EXPECT_TRUE(prepare_output(output(), Existing::resume, identity).is_complete);
    EXPECT_FALSE(fs::exists(part())) << "nothing is made where nothing is to do";
    std::string bytes = read_regular(output());
    const std::size_t at = bytes.find("bemcal-batch");
    bytes[at + 7] = 'c';
    folder_.write("o.h5", bytes);
    expect_refused(Existing::resume, "is damaged");
}

TEST_F(Part, ADamagedResultBesideItsFailedItemsIsNotCalledUnfinished) {
    store::ResultFile result;
    result.attributes = {{"program", "bemcal-batch"}, {"identity", hash_of(identity)}};
    store::write_result(output(), result);
    leave_run();
    EXPECT_FALSE(is_unfinished(output()));
    std::string bytes = read_regular(output());
    bytes[bytes.find("bemcal-batch") + 7] = 'c';
    folder_.write("o.h5", bytes);
    EXPECT_FALSE(is_unfinished(output()));
    fs::remove(output());
    EXPECT_TRUE(is_unfinished(output()));
}

TEST_F(Part, StrangeNamesStandInOneLine) {
    const Identity strange{{"version", "1"}, {"file a\nb\tc", "1"}};
    fs::create_directories(part());
    write_identity(part(), strange);
    EXPECT_TRUE(read_identity(part()).is_sound);
    EXPECT_EQ(difference(read_identity(part()).entries, strange), "");
}

}  // namespace
}  // namespace bemcal::run
