/// Public holidays of Denmark, Estonia, Finland, Latvia, Lithuania, Norway and Sweden.
/// Source: the countries' laws, by python-holidays 0.10.1 (MIT), with later changes;
/// Latvia by its law of 1990, "Par svētku, atceres un atzīmējamām dienām", and its
/// bridges by python-holidays 0.109. Eves on which offices are closed by custom count in
/// Finland and Sweden. Left out: Sundays, which are holidays by law in Norway and Sweden,
/// and half days.
#include "holidays/countries.hpp"

namespace bemcal::holidays {
namespace {

// clang-format off: a row a line
constexpr Row denmark[] = {
    {"Nytårsdag", on(1, 1)},
    {"Palmesøndag", easter(-7)},
    {"Skærtorsdag", easter(-3)},
    {"Langfredag", easter(-2)},
    {"Påskedag", easter(0)},
    {"Anden påskedag", easter(1)},
    {"Store bededag", easter(26), until(2023)},
    {"Kristi himmelfartsdag", easter(39)},
    {"Pinsedag", easter(49)},
    {"Anden pinsedag", easter(50)},
    {"Juledag", on(12, 25)},
    {"Anden juledag", on(12, 26)},
};

constexpr Row estonia[] = {
    {"uusaasta", on(1, 1)},
    {"iseseisvuspäev", on(2, 24)},
    {"suur reede", easter(-2)},
    {"ülestõusmispühade 1. püha", easter(0)},
    {"kevadpüha", on(5, 1)},
    {"nelipühade 1. püha", easter(49)},
    {"võidupüha", on(6, 23)},
    {"jaanipäev", on(6, 24)},
    {"taasiseseisvumispäev", on(8, 20)},
    {"jõululaupäev", on(12, 24)},
    {"esimene jõulupüha", on(12, 25)},
    {"teine jõulupüha", on(12, 26)},
};

constexpr Row finland[] = {
    {"Uudenvuodenpäivä", on(1, 1)},
    {"Loppiainen", on(1, 6)},
    {"Pitkäperjantai", easter(-2)},
    {"Pääsiäispäivä", easter(0)},
    {"2. pääsiäispäivä", easter(1)},
    {"Vappu", on(5, 1)},
    {"Helatorstai", easter(39)},
    {"Helluntaipäivä", easter(49)},
    {"Juhannusaatto", from(friday, 6, 19)},
    {"Juhannuspäivä", from(saturday, 6, 20)},
    {"Pyhäinpäivä", from(saturday, 10, 31)},
    {"Itsenäisyyspäivä", on(12, 6)},
    {"Jouluaatto", on(12, 24)},
    {"Joulupäivä", on(12, 25)},
    {"Tapaninpäivä", on(12, 26)},
};

constexpr int latvia_bridges[] = {
    20100503, 20100625, 20101119, 20120430, 20131223, 20131230, 20140502, 20141117,
    20150102, 20150622, 20170505, 20180430, 20200622, 20210503, 20210625, 20211119,
    20230505, 20241223, 20241230, 20250502, 20251117, 20260102, 20260622};

constexpr Row latvia[] = {
    {"Jaungada diena", on(1, 1)},
    {"Lielā Piektdiena", easter(-2)},
    {"Lieldienas", easter(0)},
    {"Otrās Lieldienas", easter(1)},
    {"Darba svētki", on(5, 1)},
    {"Neatkarības atjaunošanas diena", on(5, 4), until(2007)},
    {"Neatkarības atjaunošanas diena", on(5, 4), since(2008), weekend_to_monday},
    {"Mātes diena", nth(2, sunday, 5)},
    {"Vasarsvētki", easter(49)},
    {"Hokeja bronza", on(5, 29), only(2023)},
    {"Līgo diena", on(6, 23)},
    {"Jāņu diena", on(6, 24)},
    {"Dziesmu svētku noslēgums", on(7, 8), only(2018), sunday_to_monday},
    {"Dziesmu svētku noslēgums", on(7, 9), only(2023), sunday_to_monday},
    {"Pāvesta vizīte", on(9, 24), only(2018)},
    {"Proklamēšanas diena", on(11, 18), until(2006)},
    {"Proklamēšanas diena", on(11, 18), since(2007), weekend_to_monday},
    {"Ziemassvētku vakars", on(12, 24), since(2007)},
    {"Ziemassvētki", on(12, 25)},
    {"Otrie Ziemassvētki", on(12, 26)},
    {"Vecgada diena", on(12, 31)},
    {"Pārceltā darba diena", listed(latvia_bridges)},
};

constexpr Row lithuania[] = {
    {"Naujieji metai", on(1, 1)},
    {"Valstybės atkūrimo diena", on(2, 16)},
    {"Nepriklausomybės atkūrimo diena", on(3, 11)},
    {"Velykos", easter(0)},
    {"Velykų antroji diena", easter(1)},
    {"Tarptautinė darbo diena", on(5, 1)},
    {"Motinos diena", nth(1, sunday, 5)},
    {"Tėvo diena", nth(1, sunday, 6)},
    {"Joninės", on(6, 24), since(2003)},
    {"Valstybės diena", on(7, 6)},
    {"Žolinė", on(8, 15)},
    {"Visų šventųjų diena", on(11, 1)},
    {"Vėlinės", on(11, 2), since(2020)},
    {"Kūčios", on(12, 24)},
    {"Kalėdų pirma diena", on(12, 25)},
    {"Kalėdų antra diena", on(12, 26)},
};

constexpr Row norway[] = {
    {"Første nyttårsdag", on(1, 1)},
    {"Skjærtorsdag", easter(-3)},
    {"Langfredag", easter(-2)},
    {"Første påskedag", easter(0)},
    {"Andre påskedag", easter(1)},
    {"Arbeidernes dag", on(5, 1)},
    {"Grunnlovsdag", on(5, 17)},
    {"Kristi himmelfartsdag", easter(39)},
    {"Første pinsedag", easter(49)},
    {"Andre pinsedag", easter(50)},
    {"Første juledag", on(12, 25)},
    {"Andre juledag", on(12, 26)},
};

constexpr Row sweden[] = {
    {"Nyårsdagen", on(1, 1)},
    {"Trettondedag jul", on(1, 6)},
    {"Långfredagen", easter(-2)},
    {"Påskdagen", easter(0)},
    {"Annandag påsk", easter(1)},
    {"Första maj", on(5, 1)},
    {"Kristi himmelsfärdsdag", easter(39)},
    {"Pingstdagen", easter(49)},
    {"Annandag pingst", easter(50), until(2004)},
    {"Sveriges nationaldag", on(6, 6), since(2005)},
    {"Midsommarafton", from(friday, 6, 19)},
    {"Midsommardagen", from(saturday, 6, 20)},
    {"Alla helgons dag", from(saturday, 10, 31)},
    {"Julafton", on(12, 24)},
    {"Juldagen", on(12, 25)},
    {"Annandag jul", on(12, 26)},
    {"Nyårsafton", on(12, 31)},
};
// clang-format on

constexpr Country countries_of_northern_europe[] = {
    {"DK", "Denmark", denmark}, {"EE", "Estonia", estonia},
    {"FI", "Finland", finland}, {"LT", "Lithuania", lithuania},
    {"LV", "Latvia", latvia},   {"NO", "Norway", norway},
    {"SE", "Sweden", sweden},
};

}  // namespace

std::span<const Country> northern_europe() {
    return countries_of_northern_europe;
}

}  // namespace bemcal::holidays
