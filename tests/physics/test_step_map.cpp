#include "physics/step_map.hpp"

#include <gtest/gtest.h>

using namespace bemcal;
using namespace bemcal::physics;

namespace {

/// A zone with every refinement.
Network refined() {
    Network network;
    network.A_f = 100;
    network.A_m = 250;
    network.A_tot = 450;
    network.C_m = 1.65e7;
    network.H_tr_w = 40;
    network.H_tr_em = 60;
    network.H_tr_ms = 9.1 * network.A_m;
    network.H_tr_is = 3.45 * network.A_tot;
    network.H_ve = 50;
    network.air_capacity = 5e5;
    network.H_2 = 80;
    network.C_2 = 3e7;
    network.tau_emitter = 1800;
    network.radiant_share = 0.4;
    return network;
}

void expect_equal(const StepMap& a, const StepMap& b) {
    for (const auto form :
         {&StepMap::theta_m_after, &StepMap::theta_m2_after, &StepMap::phi_emitter_after,
          &StepMap::theta_m, &StepMap::theta_s, &StepMap::theta_air})
        for (std::size_t term = 0; term < n_terms; ++term)
            EXPECT_EQ((a.*form)[static_cast<Term>(term)],
                      (b.*form)[static_cast<Term>(term)]);
}

}  // namespace

// A number that the map follows from and that is not looked at would leave an old map.
TEST(StepMaps, AnyNumberThatChangesMakesANewMap) {
    constexpr double hour = 3600;
    const Network first = refined();
    for (double Network::* number :
         {&Network::A_f, &Network::A_m, &Network::A_tot, &Network::C_m, &Network::H_tr_w,
          &Network::H_tr_em, &Network::H_tr_ms, &Network::H_tr_is, &Network::H_ve,
          &Network::gains_air_share, &Network::sun_air_share, &Network::phi_sky,
          &Network::air_capacity, &Network::H_2, &Network::C_2, &Network::tau_emitter,
          &Network::radiant_share, &Network::band}) {
        StepMaps maps;
        expect_equal(maps.of(first, hour), make_step_map(first, hour));
        Network other = first;
        other.*number = 1.1 * first.*number + 0.01;
        expect_equal(maps.of(other, hour), make_step_map(other, hour));
        expect_equal(maps.of(other, 0.5 * hour), make_step_map(other, 0.5 * hour));
    }
}

TEST(StepMaps, TheSameNumbersKeepTheMap) {
    StepMaps maps;
    const StepMap* map = &maps.of(refined(), 3600);
    Network other = refined();
    other.phi_sky = 500;  // no part of it
    EXPECT_EQ(&maps.of(other, 3600), map);
    expect_equal(*map, make_step_map(refined(), 3600));
}
