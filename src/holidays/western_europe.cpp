/// Public holidays of Austria, Belgium, France, Germany, Luxembourg, the Netherlands and
/// Switzerland, with the Laender and the cantons.
/// Source: the countries' laws, by python-holidays 0.10.1 (MIT), with later changes.
/// Left out: the overseas parts of France, Alsace and Moselle, days of towns (Augsburg),
/// and of parts of a Land or a canton.
#include "holidays/countries.hpp"

namespace bemcal::holidays {
namespace {

// clang-format off: a row a line
constexpr Row austria[] = {
    {"Neujahr", on(1, 1)},
    {"Heilige Drei Könige", on(1, 6)},
    {"Ostermontag", easter(1)},
    {"Staatsfeiertag", on(5, 1)},
    {"Christi Himmelfahrt", easter(39)},
    {"Pfingstmontag", easter(50)},
    {"Fronleichnam", easter(60)},
    {"Mariä Himmelfahrt", on(8, 15)},
    {"Nationalfeiertag", on(10, 26)},
    {"Allerheiligen", on(11, 1)},
    {"Mariä Empfängnis", on(12, 8)},
    {"Christtag", on(12, 25)},
    {"Stefanitag", on(12, 26)},
};

constexpr Row belgium[] = {
    {"Nieuwjaarsdag", on(1, 1)},
    {"Pasen", easter(0)},
    {"Paasmaandag", easter(1)},
    {"O.L.H. Hemelvaart", easter(39)},
    {"Pinksteren", easter(49)},
    {"Pinkstermaandag", easter(50)},
    {"Dag van de Arbeid", on(5, 1)},
    {"Nationale feestdag", on(7, 21)},
    {"O.L.V. Hemelvaart", on(8, 15)},
    {"Allerheiligen", on(11, 1)},
    {"Wapenstilstand", on(11, 11)},
    {"Kerstmis", on(12, 25)},
};

constexpr Row france[] = {
    {"Jour de l'an", on(1, 1)},
    {"Lundi de Pâques", easter(1)},
    {"Fête du Travail", on(5, 1)},
    {"Armistice 1945", on(5, 8)},
    {"Ascension", easter(39)},
    {"Lundi de Pentecôte", easter(50)},
    {"Fête nationale", on(7, 14)},
    {"Assomption", on(8, 15)},
    {"Toussaint", on(11, 1)},
    {"Armistice 1918", on(11, 11)},
    {"Noël", on(12, 25)},
};

constexpr Row germany[] = {
    {"Neujahr", on(1, 1)},
    {"Heilige Drei Könige", on(1, 6), always, none, "BW BY ST"},
    {"Frauentag", on(3, 8), since(2019), none, "BE"},
    {"Frauentag", on(3, 8), since(2023), none, "MV"},
    {"Karfreitag", easter(-2)},
    {"Ostersonntag", easter(0), always, none, "BB"},
    {"Ostermontag", easter(1)},
    {"Tag der Arbeit", on(5, 1)},
    {"Tag der Befreiung", on(5, 8), only(2020), none, "BE"},
    {"Tag der Befreiung", on(5, 8), only(2025), none, "BE"},
    {"Aufstand von 1953", on(6, 17), only(2028), none, "BE"},
    {"Christi Himmelfahrt", easter(39)},
    {"Pfingstsonntag", easter(49), always, none, "BB"},
    {"Pfingstmontag", easter(50)},
    {"Fronleichnam", easter(60), always, none, "BW BY HE NW RP SL"},
    {"Mariä Himmelfahrt", on(8, 15), always, none, "BY SL"},
    {"Weltkindertag", on(9, 20), since(2019), none, "TH"},
    {"Tag der Deutschen Einheit", on(10, 3)},
    {"Reformationstag", on(10, 31), always, none, "BB MV SN ST TH"},
    {"Reformationstag", on(10, 31), only(2017), none, "!BB MV SN ST TH"},
    {"Reformationstag", on(10, 31), since(2018), none, "HB HH NI SH"},
    {"Allerheiligen", on(11, 1), always, none, "BW BY NW RP SL"},
    {"Buß- und Bettag", up_to(wednesday, 11, 22), always, none, "SN"},
    {"Erster Weihnachtstag", on(12, 25)},
    {"Zweiter Weihnachtstag", on(12, 26)},
};

constexpr Row luxembourg[] = {
    {"Neijoerschdag", on(1, 1)},
    {"Ouschterméindeg", easter(1)},
    {"Dag vun der Aarbecht", on(5, 1)},
    {"Europadag", on(5, 9), since(2019)},
    {"Christi Himmelfaart", easter(39)},
    {"Péngschtméindeg", easter(50)},
    {"Nationalfeierdag", on(6, 23)},
    {"Léiffrawëschdag", on(8, 15)},
    {"Allerhellgen", on(11, 1)},
    {"Chrëschtdag", on(12, 25)},
    {"Stiefesdag", on(12, 26)},
};

constexpr Substitute sunday_moves_to_saturday{.shift = {0, 0, 0, 0, 0, 0, -1},
                                              .moves = true};

constexpr Row netherlands[] = {
    {"Nieuwjaarsdag", on(1, 1)},
    {"Eerste paasdag", easter(0)},
    {"Tweede paasdag", easter(1)},
    {"Koninginnedag", on(4, 30), until(2013), sunday_moves_to_saturday},
    {"Koningsdag", on(4, 27), since(2014), sunday_moves_to_saturday},
    {"Bevrijdingsdag", on(5, 5), {.every = 5}},
    {"Hemelvaart", easter(39)},
    {"Eerste Pinksterdag", easter(49)},
    {"Tweede Pinksterdag", easter(50)},
    {"Eerste Kerstdag", on(12, 25)},
    {"Tweede Kerstdag", on(12, 26)},
};

constexpr const char* catholic = "AI JU LU NW OW SZ TI UR VS ZG";

constexpr Row switzerland[] = {
    {"Neujahrestag", on(1, 1)},
    {"Berchtoldstag", on(1, 2), always, none,
     "AG BE FR GL GR JU LU NE OW SH SO TG VD ZG ZH"},
    {"Heilige Drei Könige", on(1, 6), always, none, "SZ TI UR"},
    {"Ausrufung der Republik", on(3, 1), always, none, "NE"},
    {"Josefstag", on(3, 19), always, none, "NW SZ TI UR VS"},
    {"Näfelser Fahrt", from(thursday, 4, 1).unless_easter(-3, 7), always, none, "GL"},
    {"Karfreitag", easter(-2), always, none, "!VS"},
    {"Ostern", easter(0)},
    {"Ostermontag", easter(1), always, none, "!VS"},
    {"Tag der Arbeit", on(5, 1), always, none, "BL BS JU NE SH SO TG TI ZH"},
    {"Auffahrt", easter(39)},
    {"Pfingsten", easter(49)},
    {"Pfingstmontag", easter(50)},
    {"Fronleichnam", easter(60), always, none, catholic},
    {"Fest der Unabhängigkeit", on(6, 23), always, none, "JU"},
    {"Peter und Paul", on(6, 29), always, none, "TI"},
    {"Nationalfeiertag", on(8, 1)},
    {"Mariä Himmelfahrt", on(8, 15), always, none, catholic},
    {"Jeûne genevois", nth(1, sunday, 9).plus(4), always, none, "GE"},
    {"Lundi du Jeûne", nth(3, sunday, 9).plus(1), always, none, "VD"},
    {"Bruder Klaus", on(9, 25), always, none, "OW"},
    {"Allerheiligen", on(11, 1), always, none, "AI GL JU LU NW OW SG SZ TI UR VS ZG"},
    {"Mariä Empfängnis", on(12, 8), always, none, "AI LU NW OW SZ TI UR VS ZG"},
    {"Weihnachten", on(12, 25)},
    {"Stephanstag", on(12, 26), always, none,
     "AG AR AI BL BS BE FR GL GR LU NE NW OW SG SH SZ SO TG TI UR ZG ZH"},
    {"Wiederherstellung der Republik", on(12, 31), always, none, "GE"},
};
// clang-format on

constexpr Country countries_of_western_europe[] = {
    {"AT", "Austria", austria},
    {"BE", "Belgium", belgium},
    {"CH", "Switzerland", switzerland,
     "AG AI AR BE BL BS FR GE GL GR JU LU NE NW OW SG SH SO SZ TG TI UR VD VS ZG ZH"},
    {"DE", "Germany", germany, "BB BE BW BY HB HE HH MV NI NW RP SH SL SN ST TH"},
    {"FR", "France", france},
    {"LU", "Luxembourg", luxembourg},
    {"NL", "Netherlands", netherlands},
};

}  // namespace

std::span<const Country> western_europe() {
    return countries_of_western_europe;
}

}  // namespace bemcal::holidays
