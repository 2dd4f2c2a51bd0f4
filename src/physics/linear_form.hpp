/// The terms that a step of a zone is linear in, and weighted sums of them.
#pragma once

#include <array>
#include <cstddef>

namespace bemcal::physics {

/// What a step starts from.
enum class Term {
    theta_m,      ///< state: mass [degC]
    theta_m2,     ///< state: second mass [degC]
    theta_air,    ///< state: air [degC]; its coefficients are 0 without an air capacity
    phi_emitter,  ///< state: heat leaving the emitter [W]; 0 without a lag
    theta_em,     ///< behind the opaque elements [degC]
    theta_e,      ///< at windows [degC]
    theta_sup,    ///< supply air [degC]
    phi_ia,
    phi_st,
    phi_m,  ///< gains of the nodes [W]
    phi_h,  ///< asked of heating [W]; through lag and radiant share
    phi_c,  ///< asked of cooling [W], >= 0; taken from the air node at once
};
constexpr std::size_t n_terms = 12;

/// Values of the terms at one step.
struct TermValues {
    std::array<double, n_terms> value{};
    double& operator[](Term term) { return value[static_cast<std::size_t>(term)]; }
    double operator[](Term term) const { return value[static_cast<std::size_t>(term)]; }
};

/// A quantity as a weighted sum of the terms.
struct LinearForm {
    std::array<double, n_terms> weight{};
    double& operator[](Term term) { return weight[static_cast<std::size_t>(term)]; }
    double operator[](Term term) const { return weight[static_cast<std::size_t>(term)]; }
    /// Summed in the order of the terms.
    double at(const TermValues& terms) const {
        double sum = 0;
        for (std::size_t k = 0; k < n_terms; ++k) sum += weight[k] * terms.value[k];
        return sum;
    }
};

/// The term alone.
inline LinearForm the(Term term) {
    LinearForm form;
    form[term] = 1;
    return form;
}

inline LinearForm operator+(LinearForm a, const LinearForm& b) {
    for (std::size_t k = 0; k < n_terms; ++k) a.weight[k] += b.weight[k];
    return a;
}

inline LinearForm operator*(double factor, LinearForm form) {
    for (double& weight : form.weight) weight *= factor;
    return form;
}

}  // namespace bemcal::physics
