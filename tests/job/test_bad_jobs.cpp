/// Mistakes in a job: each with its exact message and exit code, and many at once.
#include "job/bad_job.hpp"

#include <array>
#include <cctype>
#include <set>
#include <span>

#include <gtest/gtest.h>

namespace bemcal::job {
namespace {

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
}

/// Edits above it move a mistake to another line, and names that are offered in its place
/// may be those of sections with a mistake.
std::string without_numbers(const std::string& message) {
    std::string text;
    for (const char c : message.substr(0, message.find(';'))) {
        const bool is_digit = std::isdigit(static_cast<unsigned char>(c)) != 0;
        const bool is_of_line = text.ends_with(':') || text.ends_with(":N");
        if (is_digit && is_of_line)
            text += text.ends_with(':') ? "N" : "";
        else
            text += c;
    }
    return text;
}

/// The mistakes of an ending by themselves.
std::vector<std::string> mistakes_in(const Ending& ending) {
    std::vector<std::string> lines = lines_of(ending.message);
    if (lines.size() > 1) lines.pop_back();
    return lines;
}

/// The job's line with the text.
int line_with(const std::string& job, const std::string& text) {
    const std::size_t at = job.find(text);
    if (at == std::string::npos) throw std::logic_error("the job has no " + text);
    return static_cast<int>(
               std::count(job.begin(), job.begin() + static_cast<long>(at), '\n')) +
           1;
}

TEST(BadJobs, EachGivesItsExactMessageAndExitCode) {
    int n = 0;
    for (const auto& description : descriptions_of_bad_jobs()) {
        BadJob bad;
        spoil(bad, description);
        const Ending ending = ending_of(bad);
        EXPECT_EQ(ending.message, bad.message) << description.filename();
        EXPECT_EQ(ending.exit_code, bad.exit_code) << description.filename();
        ++n;
    }
    EXPECT_GE(n, 40);
}

TEST(ManyMistakes, AreToldAtOnceWithTheirLinesAndNothingThatFollowsFromThem) {
    struct Edit {
        const char *from, *to, *message;
    };
    const Edit edits[] = {
        {"seed = 7", "seed = -7", "seed = -7: expected"},
        {"step = 3600", "step = 3601", "run.step = 3601: expected"},
        {"0.6, 0.2, 0, 0, 0, 0, 0]", "0.6, 0.2, 0, 0, 0, 0]", "schedule.weekdays: has"},
        {"saturday = 0", "satruday = 0", "schedule.satruday: unknown key"},
        {"u_value = 0.9", "u_value = -0.9", "construction.u_value = -0.9: expected"},
        {"frame_fraction = 0.25", "frame_fraction = 2.5",
         "glazing.frame_fraction = 2.5: expected"},
        {"area = 120\nazimuth = 180", "area = 120\nazimut = 180",
         "zone.surface.azimut: unknown key"},
        {"density = {value = 7", "density = {value = \"7\"", "value = \"7\": expected"},
        {"cooling_cop = 3.5", "cooling_cop = \"good\"", "plant.cooling_cop = \"good\""},
        {"unit = \"kWh\"", "unit = \"kwhh\"", "meter.unit = \"kwhh\": is not"},
        {"min = 0.28", "min = 28", "parameter.min: is 28"},
        {"n_points = 256", "n_points = 0", "study.n_points = 0: expected"},
        {"hourly = [\"electricity\"]", "hourly = [\"elektricity\"]",
         "output.hourly: \"elektricity\""},
        {"column = \"T_air_C\"", "column = \"T_ari_C\"", "no column \"T_ari_C\""},
    };
    BadJob bad;
    std::string& job = bad.files["office.toml"];
    for (const Edit& edit : edits) job = replaced(job, edit.from, edit.to);
    const Ending ending = ending_of(bad);
    const std::vector<std::string> lines = lines_of(ending.message);
    ASSERT_EQ(lines.size(), std::size(edits) + 1) << ending.message;
    EXPECT_EQ(ending.exit_code, static_cast<int>(ExitCode::config));
    EXPECT_EQ(lines.back(), "14 mistakes; what depends on them was not checked");
    int line_before = 0;
    for (std::size_t k = 0; k < std::size(edits); ++k) {
        EXPECT_NE(lines[k].find(edits[k].message), std::string::npos) << lines[k];
        if (!lines[k].starts_with("office.toml:")) continue;
        const int line = std::stoi(lines[k].substr(12));
        EXPECT_GE(line, line_before) << lines[k];
        line_before = line;
    }
    EXPECT_TRUE(lines[4].starts_with(
        fmt::format("office.toml:{}: ", line_with(job, "u_value = -0.9"))));
}

TEST(ManyMistakes, InTheValuesOfOneSectionAreAllTold) {
    BadJob bad;
    std::string& job = bad.files["office.toml"];
    job = replaced(job, "floor_area = 1500", "floor_area = -1");
    job = replaced(job, "volume = 4500", "volume = \"big\"");
    job = replaced(job, "class = \"heavy\"", "class = \"hevy\"");
    job = replaced(job, "heating_capacity = 40", "heating_capacity = -40");
    const std::vector<std::string> lines = mistakes_in(ending_of(bad));
    ASSERT_EQ(lines.size(), 4U);
    for (const char* key : {"floor_area", "volume", "class", "heating_capacity"})
        EXPECT_EQ(std::ranges::count_if(lines,
                                        [&](const std::string& line) {
                                            return line.find(std::string("zone.") + key +
                                                             " = ") != std::string::npos;
                                        }),
                  1)
            << key;
}

/// A mistake that somebody makes in the sample job.
struct Slip {
    const char *from, *to;
};

/// What is told of the sample with these mistakes, in order of the words.
std::vector<std::string> told_of(std::span<const Slip> slips) {
    BadJob bad;
    std::string& job = bad.files["office.toml"];
    for (const Slip& slip : slips) job = replaced(job, slip.from, slip.to);
    std::vector<std::string> told;
    for (const std::string& message : mistakes_in(ending_of(bad)))
        told.push_back(without_numbers(message));
    std::ranges::sort(told);
    return told;
}

/// Together they give what each gives alone: all of it, and nothing that follows. Those
/// that are left when any one is repaired are told, too; when all are, none is.
void expect_all_told(std::span<const Slip> slips) {
    std::vector<std::string> expected;
    for (std::size_t k = 0; k < slips.size(); ++k) {
        const std::vector<std::string> alone = told_of(slips.subspan(k, 1));
        ASSERT_EQ(alone.size(), 1U) << slips[k].to;
        expected.push_back(alone[0]);
    }
    for (std::size_t repaired = 0; repaired < slips.size(); ++repaired) {
        std::vector<Slip> left(slips.begin(), slips.end());
        left.erase(left.begin() + static_cast<std::ptrdiff_t>(repaired));
        std::vector<std::string> rest = expected;
        rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(repaired));
        std::ranges::sort(rest);
        EXPECT_EQ(told_of(left), rest) << "without " << slips[repaired].to;
    }
    std::ranges::sort(expected);
    EXPECT_EQ(told_of(slips), expected);
    EXPECT_TRUE(told_of({}).empty());
}

TEST(ManyMistakes, InPartsOfAZoneAreToldBesideAMissingNumberOfIt) {
    const Slip slips[] = {
        {"files = [\"weather.csv\"]", "files = [\"wether.csv\"]"},
        {"volume = 4500", ""},
        {"low = 28, schedule = \"plant\"", "low = 28, schedule = \"plnat\""},
        {"azimuth = 180", "azimuth = 400"},
        {"carrier = \"electricity\"", "carier = \"electricity\""},
        {"column = \"elec_kWh\"", "column = \"gas\""},
        {"construction.wall.u_value", "construction.walls.u_value"},
        {"office.cooling_set_point", "office.coolingsetpoint"},
        {"kind = \"screening\"", "kind = \"screning\""}};
    expect_all_told(slips);
}

TEST(ManyMistakes, AreToldWhereverTwentyOfThemAre) {
    const Slip slips[] = {
        {"seed = 7", "sed = 7"},
        {"files = [\"weather.csv\"]", "files = [\"wether.csv\"]"},
        {"training = [\"2021-01-01\"", "training = [\"2021-13-01\""},
        {"1, 1, 1, 0.6, 0.2, 0,", "1, 1, 1, 0.6, 0.2,"},
        {"solar_absorptance = 0.7", "solar_absorptance = 7"},
        {"u_value = 0.9", "u_value = \"0.9\""},
        {"frame_fraction = 0.25", "frame_fraction = 2.5"},
        {"floor_area = 1500", "floor_area = -1500"},
        {"class = \"heavy\"", "class = \"hevy\""},
        {"low = 28, schedule = \"plant\"", "low = 28, schedule = \"plnat\""},
        {"construction = \"wall\"", "construction = \"wal\""},
        {"area = 120\nazimuth = 180", "area = 120\nazimuth = 400"},
        {"area = 500\ntilt", "area = 0\ntilt"},
        {"glazing = \"double\"\narea = 80", "glazing = \"single\"\narea = 80"},
        {"azimuth = 180\nshading_factor", "shading_factor"},
        {"name = \"ventilation\"", "name = \"infiltration\""},
        {"low = 3, schedule", "low = \"3\", schedule"},
        {"carrier = \"electricity\"", "carier = \"electricity\""},
        {"heating_carrier = \"gas\"", "heating_carrier = \"oil\""},
        {"cooling_cop = 3.5", "cooling_cop = 350"},
        {"file = \"measured.csv\"", "file = \"measurd.csv\""},
        {"unit = \"kWh\"", "unit = \"kwh\""},
        {"mask = [\"2021-01-20", "mask = [\"2021-01-40"},
        {"column = \"T_air_C\"", "column = \"T_C\""},
        {"infiltration.air_change", "infiltration.airchange"},
        {"max = 0.52", "max = 0.2"},
        {"mode = \"factor\"", "mode = \"factr\""},
        {"kind = \"sensitivity\"", "kind = \"sensitivty\""},
        {"n_points = 256", "n_points = 0"}};
    expect_all_told(slips);
}

TEST(ManyMistakes, OfMetersAreToldBesideAWrongDateOfAPeriod) {
    const Slip slips[] = {{"held_out = [\"2021-02-01\"", "held_out = [\"2021-02-31\""},
                          {"file = \"measured.csv\"", "file = \"measurd.csv\""}};
    expect_all_told(slips);
}

/// A number of the zone, the weather's file, and names of all kinds in studies.
TEST(ManyMistakes, OfNamesInStudiesAreToldBesideThoseInTheSectionsOfTheNames) {
    const Slip slips[] = {
        {"files = [\"weather.csv\"]", "files = [\"wether.csv\"]"},
        {"floor_area = 1500", "floor_area = -1500"},
        {"n_base = 64", "n_base = 64\nperiod = \"heldout\""},
        {"kind = \"screening\"\nn_points = 256\npoints_per_item = 64",
         "kind = \"posterior\"\nmeters = [\"electricty\"]"},
        {"[output]",
         "[[study]]\nkind = \"optimisation\"\nparameters = [\"wals\"]\n"
         "\n[output]"},
        {"[[study]]\nkind = \"sensitivity\"",
         "[[study]]\nkind = \"grid\"\nk = 3\n[[study.target]]\n"
         "quantity = \"electricity\"\nmeasured = 100\n[study.grid]\n"
         "infiltraton = [0.3, 0.4, 0.5]\n\n[[study]]\nkind = \"sensitivity\""}};
    expect_all_told(slips);
}

/// The sample with its studies and others behind them.
std::vector<std::string> told_of_studies(const std::string& studies,
                                         std::span<const Slip> slips) {
    BadJob bad;
    std::string& job = bad.files["office.toml"];
    job = replaced(job, "[output]", studies + "\n[output]");
    for (const Slip& slip : slips) job = replaced(job, slip.from, slip.to);
    return mistakes_in(ending_of(bad));
}

TEST(ManyMistakes, OfNamesInOneStudyAreAllToldWithWhatIsMeant) {
    const std::string studies =
        "[[study]]\nkind = \"posterior\"\nperiod = \"heldout\"\n"
        "parameters = [\"wals\", \"walls\", \"set_piont\"]\n"
        "meters = [\"electricty\", \"air\"]\n\n"
        "[[study]]\nkind = \"retrofit\"\nof = \"screning\"\n";
    const char* messages[] = {
        "study.period = \"heldout\": small_office has no such period",
        "\"wals\" is no parameter of small_office; did you mean \"walls\"?",
        "\"set_piont\" is no parameter of small_office; did you mean \"set_point\"?",
        "\"electricty\" is no meter of small_office; did you mean \"electricity\"?",
        "study.of = \"screning\": no study above has this name"};
    const Slip slip{"files = [\"weather.csv\"]", "files = [\"wether.csv\"]"};
    const std::vector<std::string> alone = told_of_studies(studies, {});
    ASSERT_EQ(alone.size(), std::size(messages)) << alone[0];
    for (std::size_t k = 0; k < alone.size(); ++k)
        EXPECT_NE(alone[k].find(messages[k]), std::string::npos) << alone[k];
    const std::vector<std::string> told = told_of_studies(studies, {&slip, 1});
    EXPECT_EQ(told.size(), alone.size() + 1);
    for (const std::string& message : alone)
        EXPECT_EQ(std::ranges::count(told, message), 1) << message;
}

/// Of a lost section the name may be the one that is meant.
TEST(ManyMistakes, LetNamesWaitThatMayBeThoseOfASectionThatWasLost) {
    const std::string studies =
        "[[study]]\nkind = \"posterior\"\nperiod = \"second\"\n"
        "parameters = [\"second\"]\nmeters = [\"second\"]\n\n"
        "[[study]]\nkind = \"grid\"\nk = 3\n[study.grid]\nsecond = [1, 2, 3]\n"
        "[[study.target]]\nquantity = \"electricity\"\nmeter = \"second\"\n\n"
        "[[study]]\nkind = \"retrofit\"\nof = \"second\"\n";
    const Slip slips[] = {
        {"[periods]", "[period]"},
        {"name = \"air\"", "nmae = \"second\""},
        {"[[parameter]]\nname = \"walls\"", "[[paramter]]\nname = \"second\""},
        {"kind = \"screening\"", "kind = \"screening\"\nnmae = \"second\""}};
    const std::vector<std::string> told = told_of_studies(studies, slips);
    EXPECT_EQ(told.size(), std::size(slips)) << told.back();
    for (const std::string& message : told)
        EXPECT_NE(message.find("unknown key") != std::string::npos ||
                      message.find("is no key of kind") != std::string::npos,
                  false)
            << message;
}

TEST(ManyMistakes, LetNamesOfParametersWaitThatAStructureMayBring) {
    const std::string studies =
        "[[study]]\nkind = \"posterior\"\nparameters = [\"surface_area_ratio\"]\n";
    const Slip slips[] = {{"[site]", "structure = [\"surfaces\"]\n\n[site]"},
                          {"files = [\"weather.csv\"]", "files = [\"wether.csv\"]"}};
    EXPECT_TRUE(told_of_studies(studies, {slips, 1}).empty());
    EXPECT_EQ(told_of_studies(studies, slips).size(), 1U);
}

/// Each building in a file of its own, whose sections the job's stand in for.
TEST(ManyMistakes, OfNamesInStudiesAreToldOfBuildingsInFiles) {
    BadJob bad;
    std::string building = small_office_text();
    building = building.substr(building.find("[site]"));
    building = building.substr(0, building.find("[[study]]"));
    bad.files["a.toml"] = replaced(building, "name = \"walls\"", "name = \"fabric\"");
    bad.files["b.toml"] = replaced(building, "floor_area = 1500", "floor_area = -1500");
    bad.files["office.toml"] =
        "buildings = [\"a.toml\", \"b.toml\"]\n[[study]]\nkind = \"posterior\"\n"
        "parameters = [\"set_point\", \"walls\"]\nmeters = [\"air\"]\n";
    const std::vector<std::string> told = mistakes_in(ending_of(bad));
    ASSERT_EQ(told.size(), 2U) << told.back();
    EXPECT_TRUE(told[0].starts_with(
        "office.toml:4: study.parameters: \"walls\" is no parameter of a; "))
        << told[0];
    EXPECT_TRUE(told[1].starts_with("b.toml:")) << told[1];
}

/// The sample with the keys of some of its lines misspelt.
std::vector<std::string> told_of_misspelt(const std::set<std::size_t>& chosen) {
    BadJob bad;
    std::string& job = bad.files["office.toml"];
    const std::vector<std::string> lines = lines_of(job);
    job.clear();
    for (std::size_t k = 0; k < lines.size(); ++k) {
        const std::size_t end = chosen.contains(k) ? lines[k].find(" = ") : 0;
        job +=
            lines[k].substr(0, end) + (end > 0 ? "x" : "") + lines[k].substr(end) + "\n";
    }
    return mistakes_in(ending_of(bad));
}

/// Each key misspelt is one mistake, and many of them give no other.
TEST(ManyMistakes, InTheNamesOfKeysAreToldAndNothingThatFollows) {
    const std::vector<std::string> lines = lines_of(small_office_text());
    std::set<std::string> alone;
    std::vector<std::size_t> keys;
    for (std::size_t k = 0; k < lines.size(); ++k) {
        if (lines[k].find(" = ") == std::string::npos) continue;
        const std::vector<std::string> told = told_of_misspelt({k});
        EXPECT_LE(told.size(), 1U) << lines[k];
        if (!told.empty()) keys.push_back(k);
        alone.insert(told.begin(), told.end());
    }
    EXPECT_GE(keys.size(), 100U);
    constexpr std::size_t n_parts = 12;
    for (std::size_t part = 0; part < n_parts; ++part) {
        std::set<std::size_t> chosen;
        for (std::size_t k = part; k < keys.size(); k += n_parts) chosen.insert(keys[k]);
        const std::vector<std::string> told = told_of_misspelt(chosen);
        EXPECT_EQ(told.size(), chosen.size());
        for (const std::string& message : told)
            EXPECT_TRUE(alone.contains(message)) << message;
    }
}

/// What a description changes: the texts that it replaces.
std::set<std::string> places_of(const std::filesystem::path& description) {
    std::set<std::string> places;
    for (const std::string& line : lines_of(text_of(description)))
        if (line.starts_with("replace: ")) places.insert(line);
    return places;
}

/// Whether one makes another study of the screening or sensitivity that the other names.
bool takes_named_study(const std::filesystem::path& one,
                       const std::filesystem::path& other) {
    return std::ranges::any_of(
        std::array{"screening", "sensitivity"}, [&](const std::string& kind) {
            const bool is_named =
                text_of(other).find("of = \"" + kind + "\"") != std::string::npos;
            return is_named &&
                   std::ranges::any_of(places_of(one), [&](const std::string& place) {
                       return place.find("kind = \"" + kind + "\"") != std::string::npos;
                   });
        });
}

/// At one place, or in numbers that one has from the other, they may make a third; so
/// does a key of the job behind a section, for it is that section's, a key that both
/// write, and a name that is not there twice where the other construction of it could
/// not be read.
bool are_apart(const std::filesystem::path& one, const std::filesystem::path& other) {
    const std::set<std::string> places = places_of(other);
    const auto is_of = [](const std::filesystem::path& file, const char* what) {
        return file.filename().string().starts_with(what);
    };
    return std::ranges::none_of(
               places_of(one),
               [&](const std::string& place) { return places.contains(place); }) &&
           !takes_named_study(one, other) && !takes_named_study(other, one) &&
           !(is_of(one, "grid_") && is_of(other, "values_")) &&
           !(is_of(one, "values_") && is_of(other, "grid_")) &&
           !(is_of(one, "layer_") && is_of(other, "same_name_")) &&
           !(is_of(one, "hours_of_") && is_of(other, "use_of_")) &&
           !(is_of(one, "holidays_") && is_of(other, "structure_")) &&
           !(is_of(one, "structure_") && is_of(other, "holidays_")) &&
           !(is_of(one, "link") && (is_of(other, "values_") || is_of(other, "target_")));
}

/// Two mistakes of different files: both are told, or the one that keeps the other from
/// being looked for; never a third.
TEST(ManyMistakes, InPairsGiveTheMessagesOfBothOrOfOneAndNoOther) {
    auto descriptions = descriptions_of_bad_jobs();
    // Those of another job, in which the sample's mistakes have no place.
    std::erase_if(descriptions, [](const std::filesystem::path& description) {
        return text_of(description).starts_with("write: ");
    });
    constexpr std::size_t n_partners = 5;
    int n_pairs = 0, n_both = 0;
    for (std::size_t k = 0; k < descriptions.size(); ++k)
        for (std::size_t step = 1; step <= n_partners; ++step) {
            // Far apart in the list, so that mistakes of all sections meet.
            const std::size_t other = (k + 23 * step) % descriptions.size();
            if (!are_apart(descriptions[k], descriptions[other])) continue;
            BadJob bad;
            std::set<std::string> expected;
            try {
                for (const std::size_t one : {k, other}) {
                    spoil(bad, descriptions[one]);
                    expected.insert(without_numbers(bad.message));
                }
            } catch (const std::logic_error&) {
                continue;
            }
            const auto told = mistakes_in(ending_of(bad));
            EXPECT_FALSE(told.empty());
            for (const std::string& message : told)
                EXPECT_TRUE(expected.contains(without_numbers(message)))
                    << descriptions[k].filename() << " and "
                    << descriptions[other].filename() << ": " << message;
            ++n_pairs;
            n_both += told.size() == 2;
        }
    std::printf("measured: both told in %d of %d pairs\n", n_both, n_pairs);
    EXPECT_GE(n_pairs, 700);
    EXPECT_GE(n_both, n_pairs / 3);
}

}  // namespace
}  // namespace bemcal::job
