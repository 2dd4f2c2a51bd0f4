/// Public holidays of India and Singapore.
/// Source: India's gazetted holidays of its central government's offices; Singapore's
/// Holidays Act and the Ministry of Manpower's lists. Days of the Islamic and Hindu
/// calendars are announced each year: they are lists, by python-holidays 0.10.1 and 0.109
/// (MIT), estimated after 2026.
/// Left out: India's states, and days that its offices may choose.
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

constexpr int india_buddha[] = {
    20100527, 20110517, 20120506, 20130525, 20140514, 20150504, 20160521,
    20170510, 20180430, 20190518, 20200507, 20210526, 20220516, 20230505,
    20240523, 20250512, 20260501, 20270520, 20280508, 20290527, 20300517};
constexpr int india_nanak[] = {20101121, 20111110, 20121128, 20131117, 20141106, 20151125,
                               20161114, 20171104, 20181123, 20191112, 20201130, 20211119,
                               20221108, 20231127, 20241115, 20251105, 20261124, 20271114,
                               20281102, 20291121, 20301110};
constexpr int india_mahavir[] = {
    20100428, 20110416, 20120405, 20130424, 20140413, 20150402, 20160420,
    20170409, 20180329, 20190417, 20200406, 20210425, 20220414, 20230404,
    20240421, 20250410, 20260331, 20270418, 20280407, 20290426, 20300416};
constexpr int india_muharram[] = {
    20101217, 20111206, 20121125, 20131114, 20141104, 20151024, 20161012,
    20171001, 20180921, 20190910, 20200830, 20210819, 20220809, 20230729,
    20240717, 20250706, 20260626, 20270616, 20280604, 20290524, 20300513};
constexpr int india_prophet[] = {
    20100227, 20110216, 20120205, 20130125, 20140114, 20150104, 20151224, 20161213,
    20171202, 20181121, 20191110, 20201030, 20211019, 20221009, 20230928, 20240916,
    20250905, 20260826, 20270815, 20280804, 20290725, 20300714};

// clang-format off: a row a line
constexpr Row india[] = {
    {"Makar Sankranti", on(1, 14)},
    {"Republic Day", on(1, 26)},
    {"Holi", listed(india_holi)},
    {"Good Friday", easter(-2)},
    {"Mahavir Jayanti", listed(india_mahavir)},
    {"Labour Day", on(5, 1)},
    {"Buddha Purnima", listed(india_buddha)},
    {"Id-ul-Fitr", listed(india_fitr)},
    {"Id-ul-Zuha", listed(india_adha)},
    {"Independence Day", on(8, 15)},
    {"Gandhi Jayanti", on(10, 2)},
    {"Dussehra", listed(india_dussehra)},
    {"Diwali", listed(india_diwali)},
    {"Guru Nanak's Birthday", listed(india_nanak)},
    {"Muharram", listed(india_muharram)},
    {"Milad-un-Nabi", listed(india_prophet)},
    {"Christmas", on(12, 25)},
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
    20250607, 20260527, 20270517, 20280505, 20290425, 20300414};
constexpr int singapore_vesak[] = {
    20010507, 20020527, 20030515, 20040602, 20050523, 20060512, 20070531, 20080519,
    20090509, 20100528, 20110517, 20120505, 20130524, 20140513, 20150601, 20160521,
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
// clang-format on

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
