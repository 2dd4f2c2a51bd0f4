/// From adjoints of a step's map to those of the network: the elimination's lines in
/// reverse (of a = b c follow of_b += of_a c and of_c += of_a b).
/// Follows from step_map.cpp. Only the forms after the step and the air are taken back:
/// means of mass and surface, and delivered heat, have no adjoints.
#include "adjoint/step_map_adjoint.hpp"

#include "physics/step_parts.hpp"

namespace bemcal::adjoint {

namespace {

double dot(const physics::LinearForm& a, const physics::LinearForm& b) {
    double sum = 0;
    for (std::size_t k = 0; k < physics::n_terms; ++k) sum += a.weight[k] * b.weight[k];
    return sum;
}

void add(physics::LinearForm& to, double factor, const physics::LinearForm& form) {
    for (std::size_t k = 0; k < physics::n_terms; ++k)
        to.weight[k] += factor * form.weight[k];
}

/// Adjoints of StepParts, filled from its last line to its first.
class PartsBack {
  public:
    PartsBack(const physics::Network& network, double dt, physics::Network& of_network)
        : n_(network),
          dt_(dt),
          of_(of_network),
          p_(physics::make_step_parts(network, dt)) {}

    void pull(const physics::StepMap& of_map) {
        after(of_map);
        air_temperature(of_map.theta_air);
        surface_temperature();
        mass_temperature();
        mass();
        surface();
        air();
        node_powers();
        emitter(of_map.phi_emitter_after);
        of_.C_m += of_C_m_ * 2 / dt_;
        of_.C_2 += of_C_second_ * 2 / dt_;
        of_.air_capacity += of_C_air_ / dt_;
        pull_radiant_split(n_, of_split_, of_);
    }

  private:
    /// theta_m_after and theta_m2_after.
    void after(const physics::StepMap& of_map) {
        const physics::LinearForm &mass = of_map.theta_m_after,
                                  &second = of_map.theta_m2_after;
        add(of_theta_m_, 2, mass);
        add(of_theta_m_, 2 * (1 - p_.kept_second), second);
        of_kept_second_ +=
            2 * second[physics::Term::theta_m2] - 2 * dot(second, p_.theta_m);
    }

    /// D_air theta_air = air + H_is theta_s
    void air_temperature(const physics::LinearForm& of_theta_air) {
        const double per_D = 1 / p_.D_air;
        add(of_air_, per_D, of_theta_air);
        add(of_theta_s_, per_D * n_.H_tr_is, of_theta_air);
        const double of_s = per_D * dot(of_theta_air, p_.theta_s);
        of_.H_tr_is += of_s;
        of_D_air_ -= per_D * (per_D * dot(of_theta_air, p_.air) + n_.H_tr_is * of_s);
    }

    /// D_s theta_s = surface + H_ms theta_m
    void surface_temperature() {
        const double per_D = 1 / p_.D_s;
        add(of_surface_, per_D, of_theta_s_);
        add(of_theta_m_, per_D * n_.H_tr_ms, of_theta_s_);
        of_.H_tr_ms += per_D * dot(of_theta_s_, p_.theta_m);
        of_D_s_ -= per_D * dot(of_theta_s_, p_.theta_s);
    }

    /// D_m theta_m = mass, D_m = C_m + H_em + H_3 + H_second
    void mass_temperature() {
        const double per_D = 1 / p_.D_m;
        add(of_mass_, per_D, of_theta_m_);
        const double of_D_m = -per_D * dot(of_theta_m_, p_.theta_m);
        of_C_m_ += of_D_m;
        of_.H_tr_em += of_D_m;
        of_H_second_ += of_D_m;
        of_.H_tr_ms += of_D_m * p_.H_2 / p_.D_s;  // H_3 = H_ms H_2 / D_s
        of_H_2_ += of_D_m * n_.H_tr_ms / p_.D_s;
        of_D_s_ -= of_D_m * p_.H_3 / p_.D_s;
    }

    /// mass = C_m theta_m + H_em theta_em + phi_m + H_second theta_m2 + H_ms / D_s
    /// surface
    void mass() {
        of_C_m_ += of_mass_[physics::Term::theta_m];
        of_.H_tr_em += of_mass_[physics::Term::theta_em];
        of_H_second_ += of_mass_[physics::Term::theta_m2];
        const double share = n_.H_tr_ms / p_.D_s, of_share = dot(of_mass_, p_.surface);
        add(of_surface_, share, of_mass_);
        of_.H_tr_ms += of_share / p_.D_s;
        of_D_s_ -= of_share * share / p_.D_s;
        second_mass();
    }

    /// H_second = H_2 kept, kept = C / (C + H_2)
    void second_mass() {
        if (n_.H_2 <= 0) return;
        const double kept = p_.kept_second, sum = p_.C_second + n_.H_2;
        const double of_kept = of_kept_second_ + of_H_second_ * n_.H_2;
        of_.H_2 += of_H_second_ * kept - of_kept * kept / sum;
        of_C_second_ += of_kept * (1 - kept) / sum;
    }

    /// surface = H_w theta_e + phi_st + H_is / D_air air, D_s = H_ms + H_2,
    /// H_2 = H_1 + H_w, H_1 = H_is (C_air + H_ve) / D_air
    void surface() {
        const double share = n_.H_tr_is / p_.D_air, of_share = dot(of_surface_, p_.air);
        add(of_air_, share, of_surface_);
        of_.H_tr_ms += of_D_s_;
        of_H_2_ += of_D_s_;
        of_.H_tr_w += of_surface_[physics::Term::theta_e] + of_H_2_;
        of_.H_tr_is += of_share / p_.D_air + of_H_2_ * p_.H_1 / n_.H_tr_is;
        of_C_air_ += of_H_2_ * share;
        of_.H_ve += of_H_2_ * share;
        of_D_air_ -= (of_share * share + of_H_2_ * p_.H_1) / p_.D_air;
    }

    /// air = C_air theta_air + H_ve theta_sup + phi_ia, D_air = C_air + H_ve + H_is
    void air() {
        of_C_air_ += of_air_[physics::Term::theta_air] + of_D_air_;
        of_.H_ve += of_air_[physics::Term::theta_sup] + of_D_air_;
        of_.H_tr_is += of_D_air_;
    }

    /// The emitter's shares to air, surface and mass.
    void node_powers() {
        const physics::LinearForm& mean = p_.emitter.mean;
        const double r = n_.radiant_share;
        const double of_st = dot(of_surface_, mean), of_m = dot(of_mass_, mean);
        of_.radiant_share +=
            p_.split.to_st * of_st + p_.split.to_m * of_m - dot(of_air_, mean);
        of_split_.to_st += r * of_st;
        of_split_.to_m += r * of_m;
        add(of_mean_, 1 - r, of_air_);
        add(of_mean_, r * p_.split.to_st, of_surface_);
        add(of_mean_, r * p_.split.to_m, of_mass_);
    }

    void emitter(const physics::LinearForm& of_after) {
        const double tau = n_.tau_emitter, kept = p_.emitter.kept;
        if (tau <= 0) return;
        const double of_mean_kept =
            of_mean_[physics::Term::phi_emitter] - of_mean_[physics::Term::phi_h];
        const double of_kept =
            of_after[physics::Term::phi_emitter] - of_after[physics::Term::phi_h];
        of_.tau_emitter += of_mean_kept * ((1 - kept) / dt_ - kept / tau) +
                           of_kept * kept * dt_ / (tau * tau);
    }

    const physics::Network& n_;
    double dt_;
    physics::Network& of_;
    physics::StepParts p_;
    physics::LinearForm of_air_, of_surface_, of_mass_, of_theta_m_, of_theta_s_,
        of_mean_;
    double of_C_air_ = 0, of_C_m_ = 0, of_C_second_ = 0, of_kept_second_ = 0;
    double of_H_2_ = 0, of_H_second_ = 0, of_D_air_ = 0, of_D_s_ = 0;
    physics::RadiantSplit of_split_{0, 0};
};

/// Adjoints of StandardParts.
struct StandardBack {
    const physics::Network& n;
    const physics::StandardParts& p;
    physics::Network& of;
    double m = 0, st = 0, k_1 = 0, H_1 = 0, to_mass = 0, per_air = 0, per_surface = 0,
           per_theta_m = 0, C = 0, H = 0;

    /// Adjoints of the three factors of a form (per_m, per_st, per_ia).
    struct Factors {
        double m, st, ia;
    };
    Factors pull_form(const physics::LinearForm& form, const Factors& per) {
        const double at_air = form[physics::Term::phi_ia] + form[physics::Term::phi_h];
        const double sup = form[physics::Term::theta_sup];
        of.H_tr_em += form[physics::Term::theta_em] * per.m;
        of.H_tr_w += form[physics::Term::theta_e] * per.st;
        of.H_ve += sup * per.ia;
        H_1 += sup * per.st;
        k_1 += at_air * per.st;
        return {form[physics::Term::theta_em] * n.H_tr_em + form[physics::Term::phi_m],
                form[physics::Term::theta_e] * n.H_tr_w + sup * p.H_1 +
                    form[physics::Term::phi_st] + at_air * p.k_1,
                sup * n.H_ve + at_air};
    }

    void pull_mass(const physics::LinearForm& form) {
        const Factors of_per = pull_form(form, {p.per_mass, p.to_mass * p.per_mass, 0});
        m += of_per.m + of_per.st * p.to_mass;
        to_mass += of_per.st * p.per_mass;
        const double kept = form[physics::Term::theta_m];  // (C - H) m
        C += kept * p.per_mass;
        H -= kept * p.per_mass;
        m += kept * (p.C - p.H);
    }

    void pull_air(const physics::LinearForm& form) {
        const double half = 0.5 * p.air_per_theta_m, air_m = half * p.per_mass;
        const Factors of_per = pull_form(
            form, {air_m, p.to_mass * air_m + p.k_1 * p.per_surface, p.per_air});
        const double of_air_m = of_per.m + of_per.st * p.to_mass;
        to_mass += of_per.st * air_m;
        k_1 += of_per.st * p.per_surface;
        per_surface += of_per.st * p.k_1;
        per_air += of_per.ia;
        const double rest = p.C - p.H, kept = form[physics::Term::theta_m];
        C += kept * half * p.per_mass;
        H -= kept * half * p.per_mass;
        m += kept * half * rest + of_air_m * half;
        per_theta_m += 0.5 * (kept * (1 + rest * p.per_mass) + of_air_m * p.per_mass);
    }

    /// make_standard_parts from its last line to its first.
    void pull_parts(double dt) {
        k_1 += per_theta_m * p.to_mass;
        to_mass += per_theta_m * p.k_1;
        C -= m * p.per_mass * p.per_mass;
        H -= m * p.per_mass * p.per_mass;
        of.C_m += C / dt;
        of.H_tr_em += 0.5 * H;
        to_mass += 0.5 * H * p.H_2;
        per_surface += to_mass * n.H_tr_ms;
        const double of_D = -per_surface * p.per_surface * p.per_surface;
        of.H_tr_ms += to_mass * p.per_surface + of_D;
        const double of_H_2 = 0.5 * H * p.to_mass + of_D;
        of.H_tr_w += of_H_2;
        k_1 += (H_1 + of_H_2) * n.H_ve;
        of.H_ve += (H_1 + of_H_2) * p.k_1;
        per_air += k_1 * n.H_tr_is;
        const double of_sum = -per_air * p.per_air * p.per_air;
        of.H_tr_is += k_1 * p.per_air + of_sum;
        of.H_ve += of_sum;
    }
};

}  // namespace

void pull_step_map(const physics::Network& network, double dt,
                   const physics::StepMap& of_map, physics::Network& of_network) {
    PartsBack(network, dt, of_network).pull(of_map);
}

void pull_standard_step_map(const physics::Network& network, double dt,
                            const physics::StepMap& of_map,
                            physics::Network& of_network) {
    const physics::StandardParts parts = physics::make_standard_parts(network, dt);
    StandardBack back{network, parts, of_network};
    back.pull_mass(of_map.theta_m_after);
    back.pull_air(of_map.theta_air);
    back.pull_parts(dt);
}

void pull_radiant_split(const physics::Network& network,
                        const physics::RadiantSplit& of_split,
                        physics::Network& of_network) {
    const double per_A = 1 / network.A_tot, of_to_m = of_split.to_m - of_split.to_st;
    const double window = network.H_tr_w / 9.1 * per_A;
    of_network.A_m += of_to_m * per_A;
    of_network.H_tr_w -= of_split.to_st / 9.1 * per_A;
    of_network.A_tot += (of_split.to_st * window - of_to_m * network.A_m * per_A) * per_A;
}

}  // namespace bemcal::adjoint
