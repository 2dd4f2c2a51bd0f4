/// Public holidays of India and Singapore.
/// Source: India's gazetted holidays of its central government's offices; Singapore's
/// Holidays Act and the Ministry of Manpower's lists. Days of the Islamic and Hindu
/// calendars are announced each year: they are lists, estimated after 2026.
/// Left out: India's states, and Buddha Purnima, Guru Nanak's Birthday, Mahavir Jayanti,
/// Muharram and the Prophet's Birthday, which many offices keep.
#include "holidays/countries.hpp"

namespace bemcal::holidays {
namespace {

constexpr int india_holi[] = {20100301, 20110320, 20120308, 20130327, 20140317, 20150306,
                              20160324, 20170313, 20180302, 20190321, 20200310, 20210329,
                              20220318, 20230308, 20240325, 20250314, 20260304, 20270322,
                              20280311, 20290301, 20300320};
constexpr int india_dussehra[] = {
    20101017, 20111006, 20121024, 20131013, 20141003, 20151022, 20161011,
    20170930, 20181019, 20191008, 20201025, 20211015, 20221005, 20231024,
    20241012, 20251002, 20261020, 20271009, 20280927, 20291016, 20301006};
constexpr int india_diwali[] = {
    20101105, 20111026, 20121113, 20131103, 20141023, 20151111, 20161030,
    20171019, 20181107, 20191027, 20201114, 20211104, 20221024, 20231112,
    20241031, 20251020, 20261108, 20271029, 20281017, 20291105, 20301026};
constexpr int india_fitr[] = {20100911, 20110831, 20120820, 20130809, 20140729, 20150718,
                              20160707, 20170626, 20180616, 20190605, 20200525, 20210514,
                              20220503, 20230422, 20240411, 20250331, 20260321, 20270310,
                              20280227, 20290215, 20300205};
constexpr int india_adha[] = {20101117, 20111107, 20121027, 20131016, 20141006, 20150925,
                              20160913, 20170902, 20180822, 20190812, 20200801, 20210721,
                              20220710, 20230629, 20240617, 20250607, 20260527, 20270517,
                              20280506, 20290425, 20300414};

constexpr Row india[] = {
    {"Makar Sankranti", on(1, 14)},     {"Republic Day", on(1, 26)},
    {"Holi", listed(india_holi)},       {"Good Friday", easter(-2)},
    {"Labour Day", on(5, 1)},           {"Id-ul-Fitr", listed(india_fitr)},
    {"Id-ul-Zuha", listed(india_adha)}, {"Independence Day", on(8, 15)},
    {"Gandhi Jayanti", on(10, 2)},      {"Dussehra", listed(india_dussehra)},
    {"Diwali", listed(india_diwali)},   {"Christmas", on(12, 25)},
};

constexpr int singapore_fitr[] = {
    20011216, 20021206, 20031125, 20041114, 20051103, 20061024, 20071013, 20081001,
    20090920, 20100910, 20110830, 20120819, 20130808, 20140728, 20150717, 20160706,
    20170625, 20180615, 20190605, 20200524, 20210513, 20220503, 20230422, 20240410,
    20250331, 20260321, 20270310, 20280227, 20290215, 20300204};
constexpr int singapore_adha[] = {
    20010306, 20020223, 20030212, 20040201, 20050121, 20060110, 20071220, 20081208,
    20091127, 20101117, 20111106, 20121026, 20131015, 20141005, 20150924, 20160912,
    20170901, 20180822, 20190811, 20200731, 20210720, 20220710, 20230629, 20240617,
    20250607, 20260527, 20270517, 20280505, 20290424, 20300413};
constexpr int singapore_vesak[] = {
    20010507, 20020527, 20030515, 20040602, 20050523, 20060512, 20070531, 20080519,
    20090509, 20100528, 20110517, 20120505, 20130524, 20140513, 20150601, 20160520,
    20170510, 20180529, 20190519, 20200507, 20210526, 20220515, 20230602, 20240522,
    20250512, 20260531, 20270520, 20280509, 20290527, 20300516};
constexpr int singapore_deepavali[] = {
    20011114, 20021103, 20031023, 20041111, 20051101, 20061021, 20071108, 20081027,
    20091017, 20101105, 20111026, 20121113, 20131102, 20141022, 20151110, 20161029,
    20171018, 20181106, 20191027, 20201114, 20211104, 20221024, 20231112, 20241031,
    20251020, 20261108, 20271028, 20281017, 20291105, 20301026};
constexpr int singapore_polling[] = {20011103, 20060506, 20110507, 20110827,
                                     20150911, 20200710, 20230901, 20250503};

constexpr Row singapore[] = {
    {"New Year's Day", on(1, 1), always, sunday_to_free},
    {"Chinese New Year", chinese(1, 1), always, sunday_to_free},
    {"Chinese New Year", chinese(1, 2), always, sunday_to_free},
    {"Good Friday", easter(-2)},
    {"Hari Raya Puasa", listed(singapore_fitr), always, sunday_to_free},
    {"Labour Day", on(5, 1), always, sunday_to_free},
    {"Vesak Day", listed(singapore_vesak), always, sunday_to_free},
    {"Hari Raya Haji", listed(singapore_adha), always, sunday_to_free},
    {"SG50", on(8, 7), only(2015)},
    {"National Day", on(8, 9), always, sunday_to_free},
    {"Deepavali", listed(singapore_deepavali), always, sunday_to_free},
    {"Polling Day", listed(singapore_polling)},
    {"Christmas Day", on(12, 25), always, sunday_to_free},
};

constexpr Country countries_of_south_asia[] = {
    {.code = "IN", .name = "India", .rows = india, .first_year = 2010, .last_year = 2030},
    {.code = "SG",
     .name = "Singapore",
     .rows = singapore,
     .first_year = 2001,
     .last_year = 2030},
};

}  // namespace

std::span<const Country> south_asia() {
    return countries_of_south_asia;
}

}  // namespace bemcal::holidays
