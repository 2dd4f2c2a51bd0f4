/// Public holidays of Cyprus, Greece, Italy, Malta, Portugal and Spain.
/// Source: the countries' laws, by python-holidays 0.10.1 (MIT), with later changes;
/// Cyprus and Malta by their governments' lists. Left out: days of towns and regions,
/// Carnival where it is a custom only.
#include "holidays/countries.hpp"

namespace bemcal::holidays {
namespace {

// clang-format off: a row a line
constexpr Row cyprus[] = {
    {"New Year's Day", on(1, 1)},
    {"Epiphany", on(1, 6)},
    {"Green Monday", orthodox(-48)},
    {"Greek Independence Day", on(3, 25)},
    {"National Day", on(4, 1)},
    {"Good Friday", orthodox(-2)},
    {"Easter Sunday", orthodox(0)},
    {"Easter Monday", orthodox(1)},
    {"Labour Day", on(5, 1)},
    {"Kataklysmos", orthodox(50)},
    {"Assumption of Mary", on(8, 15)},
    {"Independence Day", on(10, 1)},
    {"Ochi Day", on(10, 28)},
    {"Christmas Day", on(12, 25)},
    {"Boxing Day", on(12, 26)},
};

/// Where 1 May is a Sunday or within Holy Week.
constexpr int greece_labour[] = {20210504, 20220502, 20240507, 20270504};

constexpr Row greece[] = {
    {"New Year's Day", on(1, 1)},
    {"Epiphany", on(1, 6)},
    {"Clean Monday", orthodox(-48)},
    {"Independence Day", on(3, 25)},
    {"Good Friday", orthodox(-2)},
    {"Easter Monday", orthodox(1)},
    {"Labour Day", on(5, 1), until(2023)},
    {"Labour Day", on(5, 1), since(2025)},
    {"Labour Day, moved", listed(greece_labour)},
    {"Monday of the Holy Spirit", orthodox(50)},
    {"Assumption of Mary", on(8, 15)},
    {"Ochi Day", on(10, 28)},
    {"Christmas Day", on(12, 25)},
    {"Second Christmas Day", on(12, 26)},
};

constexpr Row italy[] = {
    {"Capodanno", on(1, 1)},
    {"Epifania del Signore", on(1, 6)},
    {"150 anni dell'Unità", on(3, 17), only(2011)},
    {"Pasqua", easter(0)},
    {"Lunedì dell'Angelo", easter(1)},
    {"Festa della Liberazione", on(4, 25)},
    {"Festa dei Lavoratori", on(5, 1)},
    {"Festa della Repubblica", on(6, 2)},
    {"Assunzione della Vergine", on(8, 15)},
    {"San Francesco", on(10, 4), since(2026)},
    {"Tutti i Santi", on(11, 1)},
    {"Immacolata Concezione", on(12, 8)},
    {"Natale", on(12, 25)},
    {"Santo Stefano", on(12, 26)},
};

constexpr Row malta[] = {
    {"New Year's Day", on(1, 1)},
    {"Saint Paul's Shipwreck", on(2, 10)},
    {"Saint Joseph", on(3, 19)},
    {"Freedom Day", on(3, 31)},
    {"Good Friday", easter(-2)},
    {"Workers' Day", on(5, 1)},
    {"Sette Giugno", on(6, 7)},
    {"Saints Peter and Paul", on(6, 29)},
    {"Santa Marija", on(8, 15)},
    {"Victory Day", on(9, 8)},
    {"Independence Day", on(9, 21)},
    {"Immaculate Conception", on(12, 8)},
    {"Republic Day", on(12, 13)},
    {"Christmas Day", on(12, 25)},
};

constexpr Row portugal[] = {
    {"Ano Novo", on(1, 1)},
    {"Sexta-feira Santa", easter(-2)},
    {"Páscoa", easter(0)},
    {"Dia da Liberdade", on(4, 25)},
    {"Dia do Trabalhador", on(5, 1)},
    {"Corpo de Deus", easter(60), until(2012)},
    {"Corpo de Deus", easter(60), since(2016)},
    {"Dia de Portugal", on(6, 10)},
    {"Assunção de Nossa Senhora", on(8, 15)},
    {"Implantação da República", on(10, 5), until(2012)},
    {"Implantação da República", on(10, 5), since(2016)},
    {"Todos os Santos", on(11, 1), until(2012)},
    {"Todos os Santos", on(11, 1), since(2016)},
    {"Restauração da Independência", on(12, 1), until(2012)},
    {"Restauração da Independência", on(12, 1), since(2016)},
    {"Imaculada Conceição", on(12, 8)},
    {"Natal", on(12, 25)},
};

constexpr Row spain[] = {
    {"Año nuevo", on(1, 1)},
    {"Epifanía del Señor", on(1, 6)},
    {"Viernes Santo", easter(-2)},
    {"Día del Trabajador", on(5, 1)},
    {"Asunción de la Virgen", on(8, 15)},
    {"Día de la Hispanidad", on(10, 12)},
    {"Todos los Santos", on(11, 1)},
    {"Día de la Constitución", on(12, 6)},
    {"La Inmaculada Concepción", on(12, 8)},
    {"Navidad", on(12, 25)},
};
// clang-format on

constexpr Country countries_of_southern_europe[] = {
    {"CY", "Cyprus", cyprus}, {"ES", "Spain", spain}, {"GR", "Greece", greece},
    {"IT", "Italy", italy},   {"MT", "Malta", malta}, {"PT", "Portugal", portugal},
};

}  // namespace

std::span<const Country> southern_europe() {
    return countries_of_southern_europe;
}

}  // namespace bemcal::holidays
