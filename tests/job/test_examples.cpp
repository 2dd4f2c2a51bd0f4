/// The examples of `describe`: whole jobs that are read, with every key of the schema.
#include "job/examples.hpp"
#include "job/kinds.hpp"
#include "job/small_office.hpp"
#include "job/stock.hpp"

#include <cmath>
#include <set>

#include <gtest/gtest.h>

namespace bemcal::job {
namespace {

constexpr int n_hours = 24 * 59;  ///< January and February 2021
constexpr const char* town = ",48.1,11.6,1.0,520\n";

struct Hour {
    physics::Seconds begin;
    double wave, sun;  ///< from -1 to 1; from 0 to 1
};

std::vector<Hour> hours() {
    std::vector<Hour> all;
    const physics::Seconds start = physics::parse_time("2021-01-01");
    for (int k = 0; k < n_hours; ++k)
        all.push_back({start + std::chrono::hours(k), std::sin(k / 3.8),
                       std::max(0.0, std::cos(std::numbers::pi * (k % 24 - 11.5) / 10))});
    return all;
}

std::string weather_csv() {
    std::string text = "time,T_out_C,GHI,DNI,DHI,wind_kmh,RH,cloud,IR\n";
    for (const Hour& hour : hours())
        text +=
            fmt::format("{},{:.2f},{:.1f},{:.1f},{:.1f},{:.1f},70,0.5,300\n",
                        physics::format_time(hour.begin), 4 + 4 * hour.wave,
                        200 * hour.sun, 300 * hour.sun, 80 * hour.sun, 8 + 4 * hour.wave);
    return text;
}

std::string epw() {
    std::string text =
        std::string("LOCATION,Town,-,-,-,0") + town +
        "DESIGN CONDITIONS,0\nTYPICAL/EXTREME PERIODS,0\nGROUND "
        "TEMPERATURES,0\nHOLIDAYS/DAYLIGHT SAVINGS,No,0,0,0\nCOMMENTS 1,-\n"
        "COMMENTS 2,-\nDATA PERIODS,1,1,Data,Sunday,1/1,2/28\n";
    int k = 0;
    for (const Hour& hour : hours()) {
        const physics::CalendarStep step = physics::calendar_step(hour.begin);
        text += fmt::format(
            "2021,{},{},{},60,-,{:.1f},1.0,70,95000,0,0,300,{:.0f},{:.0f},{:.0f},0,0,0,0,"
            "180,2.0,5,5,10,77777,9,999999999,0,0,0,88,0,0,0\n",
            step.month, step.day, k++ % 24 + 1, 4 + 4 * hour.wave, 200 * hour.sun,
            300 * hour.sun, 80 * hour.sun);
    }
    return text;
}

std::string meters_csv() {
    std::string text = "time,gas_kwh,electricity_kwh,room_degc\n";
    for (const Hour& hour : hours())
        text += fmt::format("{},{:.2f},{:.2f},{:.1f}\n", physics::format_time(hour.begin),
                            30 + 20 * hour.wave, 12 + 6 * hour.wave, 20 + 2 * hour.wave);
    return text;
}

/// As a German export writes it, below a title and above a sum.
std::string rain_csv() {
    std::string text = "A station\nTime;Rain\n";
    for (const Hour& hour : hours()) {
        const std::string time = physics::format_time(hour.begin);  // 2021-03-05 14:00:00
        text +=
            fmt::format("{}.{}.{} {};0,{}\n", time.substr(8, 2), time.substr(5, 2),
                        time.substr(0, 4), time.substr(11, 5), hour.sun > 0.5 ? 4 : 0);
    }
    return text + "Total;500\n";
}

std::string column_csv(const char* name, double mean, double swing) {
    std::string text = fmt::format("time,{}\n", name);
    for (const Hour& hour : hours())
        text += fmt::format("{},{:.1f}\n", physics::format_time(hour.begin),
                            mean + swing * hour.wave);
    return text;
}

std::string persons_csv() {
    std::string text = "date,persons\n";
    for (int day = 0; day < n_hours / 24; ++day) {
        const auto begin = physics::parse_time("2021-01-01") + std::chrono::days(day);
        text += fmt::format("{},20\n", physics::format_time(begin).substr(0, 10));
    }
    return text;
}

constexpr const char* house =
    "plant = {heating_carrier = \"gas\", heating_efficiency = 0.9}\n"
    "construction = [{name = \"wall\", u_value = 0.8}]\n"
    "zone = [{name = \"house\", floor_area = 100, volume = 250, surface = [{construction "
    "= \"wall\", area = 200, azimuth = 0}]}]\n"
    "meter = [{name = \"gas\", quantity = \"gas\", file = \"meters.csv\", column = "
    "\"gas_kwh\", unit = \"kWh\"}]\n"
    "parameter = [{name = \"walls\", target = \"construction.wall.u_value\", min = 0.4, "
    "max = 1.6}]\n";

/// The jobs, and the files that they name.
void write_examples(const Folder& folder) {
    std::filesystem::create_directory(folder / "buildings");
    const std::pair<const char*, std::string> files[] = {
        {"weather.csv", weather_csv()},
        {"2021.epw", epw()},
        {"meters.csv", meters_csv()},
        {"buildings/meters.csv", meters_csv()},
        {"rain.csv", rain_csv()},
        {"boiler.csv", column_csv("supply_degc", 45, 5)},
        {"persons.csv", persons_csv()},
        {"bills.csv",
         "from,to,read,heat_mwh\n2021-01-01,2021-02-01,,30\n2021-02-01,2021-03-01,,25\n"},
        {"one.toml", house},
        {"two.toml", house},
        {"buildings/one.toml", house},
        {"house.toml",
         "weather = {files = [\"@weather@\"]}\n" +
             replaced(replaced(house, "floor_area = 100", "floor_area = @area@"),
                      "meters.csv", "@gas@")},
        {"town.csv",
         "name,floor_area,floors,weather,gas,gas_column\n"
         "house,120,2,2021.epw,meters.csv,gas_kwh\n"},
        {"houses.csv", "name,weather,area,gas\nhouse,2021.epw,120,meters.csv\n"},
        {"house.py", "# a program\n"},
        {"days.csv", "period,first,last\n"},
        {"house.json.in", "{\"u_value\": @u_value@}\n"},
        {"hours.dat.in", "@more_air@\n@gas_more@\n@shade@\n"},
        {"bills_by_month.csv", "outdoor,gas\n1.2,2773.8\n2.1,2631.0\n9,1000\n"},
        {"field.csv", "y,x\n1,0\n2,0.5\n3,1\n"},
        {"runs.csv", "eta,x,t\n1,0,0\n2,0.5,0\n3,1,0\n2,0,1\n3,0.5,1\n5,1,1\n"},
        {"hours.csv",
         "energy,GFA,theta_ext\n1000,20000,10\n2000,50000,15\n900,30000,30\n"}};
    for (const auto& [name, text] : files) folder.write(name, text);
    for (const ExampleJob& job : example_jobs()) folder.write(job.file, job.text);
}

TEST(Examples, AreJobsThatAreRead) {
    const Folder folder;
    write_examples(folder);
    for (const ExampleJob& example : example_jobs()) try {
            input::InputFiles files;
            const Job job = read_job(folder / example.file, files);
            EXPECT_FALSE(job.studies.empty()) << example.file;
            if (!job.stock) continue;
            EXPECT_FALSE(job.stock->lines.empty()) << example.file;
            for (const StockLine& line : job.stock->lines)
                EXPECT_EQ(read_stock_building(job, line, files).buildings.size(), 1U);
        } catch (const UserError& error) {
            ADD_FAILURE() << example.file << ": " << error.what();
        }
}

/// A key's place in the schema: kind of study ("" = none), section, key.
using Place = std::tuple<std::string, std::string, std::string>;

class Walk {
  public:
    const std::set<Place>& places() const { return places_; }

    void section(const schema::Node& node, const std::string& name, const Kind* kind) {
        for (const schema::Entry& entry : node.entries) {
            const schema::Key* row = table(kind, name).find(name, entry.key);
            if (row != nullptr) {
                const bool is_kinds = kind != nullptr && name.starts_with("study");
                places_.insert({is_kinds ? kind->word : "", row->section, entry.key});
            }
            for (const schema::Node* below : sections_in(entry.node))
                if (entry.key == "study" && name == "job")
                    study(*below);
                else if (const std::string child = below_of(name, entry.key, kind);
                         !child.empty())
                    section(*below, child, kind);
        }
    }

  private:
    static const schema::Table& table(const Kind* kind, const std::string& section) {
        return kind != nullptr && table_of(*kind).find(section) != nullptr
                   ? table_of(*kind)
                   : schema::job_table();
    }

    static std::vector<const schema::Node*> sections_in(const schema::Node& node) {
        if (node.kind == schema::Node::Kind::table) return {&node};
        std::vector<const schema::Node*> all;
        for (const schema::Entry& entry : node.entries)
            if (entry.node.kind == schema::Node::Kind::table) all.push_back(&entry.node);
        return all;
    }

    static std::string below_of(const std::string& section, const std::string& key,
                                const Kind* kind) {
        if (section == "weather.columns") return "column";
        for (const std::string& name : {section + "." + key, key, "study." + key})
            if (table(kind, name).find(name) != nullptr) return name;
        return "input";
    }

    void study(const schema::Node& node) {
        for (const schema::Entry& entry : node.entries)
            if (entry.key == "kind") section(node, "study", find_kind(entry.node.text));
    }

    std::set<Place> places_;
};

TEST(Examples, HaveEveryKeyOfTheSchema) {
    Walk walk;
    for (const ExampleJob& job : example_jobs())
        walk.section(schema::parse_document(job.text, job.file), "job", nullptr);
    std::vector<std::string> missing;
    int n = 0;
    const auto look = [&](const std::string& kind, const schema::Table& table) {
        for (const schema::SectionInfo& section : table.sections())
            for (const schema::Key& key : table.keys_of(section.name)) {
                const bool is_common =
                    common_table().find(key.section, key.key) != nullptr;
                if (is_common || std::string_view(key.section) != section.name) continue;
                ++n;
                if (!walk.places().contains({kind, key.section, key.key}))
                    missing.push_back(
                        fmt::format("{} {}.{}", kind, key.section, key.key));
            }
    };
    look("", schema::job_table());
    for (const Kind* kind : kinds()) look(kind->word, table_of(*kind));
    for (const std::string& key : missing) ADD_FAILURE() << "no example of " << key;
    std::printf("measured: %d of %d keys without an example\n",
                static_cast<int>(missing.size()), n);
    EXPECT_GE(n, 300);
}

TEST(Examples, AreCutAtHeadings) {
    EXPECT_TRUE(example_of("plant").starts_with("[plant]\nheating_carrier"));
    EXPECT_TRUE(example_of("study.grid", "grid").starts_with("[study.grid]\n"));
    EXPECT_EQ(example_of("study.grid", "stages"), "");
    EXPECT_TRUE(example_of("").starts_with("name = \"office\""));
    EXPECT_EQ(example_of("study", "retrofit").find("[[scenario]]"), std::string::npos);
}

TEST(Examples, StandUnderEachTopic) {
    for (const std::string& topic : job_topics()) {
        const std::string text = describe_topic(topic);
        EXPECT_NE(text.find("\n  Example:\n    "), std::string::npos) << topic;
        EXPECT_EQ(text.find("  Example:\n\n"), std::string::npos) << topic;
    }
    EXPECT_EQ(describe_topic("metre"), "");
}

}  // namespace
}  // namespace bemcal::job
