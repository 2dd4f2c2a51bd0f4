/// Public holidays of Bulgaria, Croatia, Czechia, Hungary, Poland, Romania, Slovakia and
/// Slovenia.
/// Source: the countries' laws, by python-holidays 0.10.1 (MIT), with later changes;
/// Romania by art. 139 of its Codul muncii.
/// Hungary's bridges follow the usual pattern, a Monday before and a Friday after;
/// Bulgaria's are those decreed (python-holidays 0.109). Left out: the Saturdays worked
/// for them.
#include "holidays/countries.hpp"

namespace bemcal::holidays {
namespace {

constexpr Years with_days_off = since(2017);  // art. 154 of Bulgaria's labour code

constexpr int bulgaria_bridges[] = {
    20100507, 20101231, 20110304, 20110523, 20110905, 20110923, 20120102,
    20120430, 20120525, 20120907, 20121231, 20130502, 20131223, 20131231,
    20140502, 20140505, 20141231, 20150102, 20150302, 20150921, 20151231,
    20160304, 20160523, 20160905, 20160923, 20251231, 20260102};

// clang-format off: a row a line
constexpr Row bulgaria[] = {
    {"New Year's Day", on(1, 1), until(2016)},
    {"New Year's Day", on(1, 1), with_days_off, weekend_to_free},
    {"Liberation Day", on(3, 3), until(2016)},
    {"Liberation Day", on(3, 3), with_days_off, weekend_to_free},
    {"Good Friday", orthodox(-2)},
    {"Holy Saturday", orthodox(-1)},
    {"Easter Sunday", orthodox(0)},
    {"Easter Monday", orthodox(1)},
    {"Labour Day", on(5, 1), until(2016)},
    {"Labour Day", on(5, 1), with_days_off, weekend_to_free},
    {"Saint George's Day", on(5, 6), until(2016)},
    {"Saint George's Day", on(5, 6), with_days_off, weekend_to_free},
    {"Day of Culture", on(5, 24), until(2016)},
    {"Day of Culture", on(5, 24), with_days_off, weekend_to_free},
    {"Unification Day", on(9, 6), until(2016)},
    {"Unification Day", on(9, 6), with_days_off, weekend_to_free},
    {"Independence Day", on(9, 22), until(2016)},
    {"Independence Day", on(9, 22), with_days_off, weekend_to_free},
    {"Christmas Eve", on(12, 24), until(2016)},
    {"Christmas Eve", on(12, 24), with_days_off, weekend_to_free},
    {"Christmas Day", on(12, 25), until(2016)},
    {"Christmas Day", on(12, 25), with_days_off, weekend_to_free},
    {"Second Christmas Day", on(12, 26), until(2016)},
    {"Second Christmas Day", on(12, 26), with_days_off, weekend_to_free},
    {"Bridge by decree", listed(bulgaria_bridges)},
};

constexpr Row croatia[] = {
    {"Nova Godina", on(1, 1)},
    {"Sveta tri kralja", on(1, 6)},
    {"Uskrs", easter(0)},
    {"Uskrsni ponedjeljak", easter(1)},
    {"Praznik rada", on(5, 1)},
    {"Dan državnosti", on(5, 30), since(2020)},
    {"Tijelovo", easter(60)},
    {"Dan antifašističke borbe", on(6, 22)},
    {"Dan državnosti", on(6, 25), until(2019)},
    {"Dan pobjede", on(8, 5)},
    {"Velika Gospa", on(8, 15)},
    {"Dan neovisnosti", on(10, 8), until(2019)},
    {"Svi sveti", on(11, 1)},
    {"Dan sjećanja", on(11, 18), since(2020)},
    {"Božić", on(12, 25)},
    {"Sveti Stjepan", on(12, 26)},
};

constexpr Row czechia[] = {
    {"Den obnovy státu", on(1, 1)},
    {"Velký pátek", easter(-2), since(2016)},
    {"Velikonoční pondělí", easter(1)},
    {"Svátek práce", on(5, 1)},
    {"Den vítězství", on(5, 8)},
    {"Den Cyrila a Metoděje", on(7, 5)},
    {"Den upálení Jana Husa", on(7, 6)},
    {"Den české státnosti", on(9, 28)},
    {"Den vzniku Československa", on(10, 28)},
    {"Den boje za svobodu", on(11, 17)},
    {"Štědrý den", on(12, 24)},
    {"1. svátek vánoční", on(12, 25)},
    {"2. svátek vánoční", on(12, 26)},
};

/// A Tuesday makes the Monday before it a day off, a Thursday the Friday after it.
constexpr Substitute bridged{.shift = {0, -1, 0, 1, 0, 0, 0}};
constexpr Substitute bridged_after{.shift = {0, 0, 0, 1, 0, 0, 0}};

constexpr Row hungary[] = {
    {"Újév", on(1, 1), until(2013)},
    {"Újév", on(1, 1), since(2014), bridged},
    {"Nemzeti ünnep", on(3, 15), until(2009)},
    {"Nemzeti ünnep", on(3, 15), since(2010), bridged},
    {"Nagypéntek", easter(-2), since(2017)},
    {"Húsvét", easter(0)},
    {"Húsvét Hétfő", easter(1)},
    {"A Munka ünnepe", on(5, 1), until(2009)},
    {"A Munka ünnepe", on(5, 1), since(2010), bridged},
    {"Pünkösd", easter(49)},
    {"Pünkösdhétfő", easter(50)},
    {"Az államalapítás ünnepe", on(8, 20), until(2009)},
    {"Az államalapítás ünnepe", on(8, 20), since(2010), bridged},
    {"Nemzeti ünnep", on(10, 23), until(2009)},
    {"Nemzeti ünnep", on(10, 23), since(2010), bridged},
    {"Mindenszentek", on(11, 1), until(2009)},
    {"Mindenszentek", on(11, 1), since(2010), bridged},
    {"Szenteste", on(12, 24), since(2010)},
    {"Karácsony", on(12, 25)},
    {"Karácsony másnapja", on(12, 26), until(2012)},
    {"Karácsony másnapja", on(12, 26), since(2013), bridged_after},
    {"Szilveszter", on(12, 31), only(2012)},
};

constexpr Row poland[] = {
    {"Nowy Rok", on(1, 1)},
    {"Święto Trzech Króli", on(1, 6), since(2011)},
    {"Niedziela Wielkanocna", easter(0)},
    {"Poniedziałek Wielkanocny", easter(1)},
    {"Święto Państwowe", on(5, 1)},
    {"Święto Trzeciego Maja", on(5, 3)},
    {"Zielone Świątki", easter(49)},
    {"Dzień Bożego Ciała", easter(60)},
    {"Wniebowzięcie NMP", on(8, 15)},
    {"Wszystkich Świętych", on(11, 1)},
    {"Święto Niepodległości", on(11, 11)},
    {"Setna rocznica niepodległości", on(11, 12), only(2018)},
    {"Wigilia", on(12, 24), since(2025)},
    {"Boże Narodzenie", on(12, 25)},
    {"Drugi dzień Bożego Narodzenia", on(12, 26)},
};

constexpr Row romania[] = {
    {"Anul Nou", on(1, 1)},
    {"Anul Nou, a doua zi", on(1, 2)},
    {"Boboteaza", on(1, 6), since(2024)},
    {"Sfântul Ioan", on(1, 7), since(2024)},
    {"Ziua Unirii", on(1, 24), since(2017)},
    {"Vinerea Mare", orthodox(-2), since(2018)},
    {"Paștele", orthodox(0)},
    {"A doua zi de Paște", orthodox(1)},
    {"Ziua Muncii", on(5, 1)},
    {"Ziua Copilului", on(6, 1), since(2017)},
    {"Rusaliile", orthodox(49), since(2008)},
    {"A doua zi de Rusalii", orthodox(50), since(2008)},
    {"Adormirea Maicii Domnului", on(8, 15), since(2009)},
    {"Sfântul Andrei", on(11, 30), since(2012)},
    {"Ziua Națională", on(12, 1)},
    {"Crăciunul", on(12, 25)},
    {"A doua zi de Crăciun", on(12, 26)},
};

constexpr Row slovakia[] = {
    {"Deň vzniku republiky", on(1, 1)},
    {"Zjavenie Pána", on(1, 6)},
    {"Veľký piatok", easter(-2)},
    {"Veľkonočný pondelok", easter(1)},
    {"Sviatok práce", on(5, 1)},
    {"Deň víťazstva", on(5, 8), until(2025)},
    {"Deň víťazstva", on(5, 8), since(2027)},
    {"Sviatok Cyrila a Metoda", on(7, 5)},
    {"Výročie povstania", on(8, 29)},
    {"Deň Ústavy", on(9, 1), until(2023)},
    {"Sedembolestná Panna Mária", on(9, 15), until(2025)},
    {"Sedembolestná Panna Mária", on(9, 15), since(2027)},
    {"100. výročie Deklarácie", on(10, 30), only(2018)},
    {"Všetkých svätých", on(11, 1)},
    {"Deň boja za slobodu", on(11, 17), {2001, 2024}},
    {"Štedrý deň", on(12, 24)},
    {"Prvý sviatok vianočný", on(12, 25)},
    {"Druhý sviatok vianočný", on(12, 26)},
};

constexpr Row slovenia[] = {
    {"novo leto", on(1, 1)},
    {"novo leto", on(1, 2), until(2012)},
    {"novo leto", on(1, 2), since(2017)},
    {"Prešernov dan", on(2, 8)},
    {"velikonočni ponedeljek", easter(1)},
    {"dan upora", on(4, 27)},
    {"praznik dela", on(5, 1)},
    {"praznik dela", on(5, 2)},
    {"dan državnosti", on(6, 25)},
    {"dan solidarnosti", on(8, 14), only(2023)},
    {"Marijino vnebovzetje", on(8, 15)},
    {"dan reformacije", on(10, 31)},
    {"dan spomina na mrtve", on(11, 1)},
    {"božič", on(12, 25)},
    {"dan samostojnosti", on(12, 26)},
};
// clang-format on

constexpr Country countries_of_eastern_europe[] = {
    {"BG", "Bulgaria", bulgaria}, {"CZ", "Czechia", czechia},
    {"HR", "Croatia", croatia},   {"HU", "Hungary", hungary},
    {"PL", "Poland", poland},     {"RO", "Romania", romania},
    {"SI", "Slovenia", slovenia}, {"SK", "Slovakia", slovakia},
};

}  // namespace

std::span<const Country> eastern_europe() {
    return countries_of_eastern_europe;
}

}  // namespace bemcal::holidays
