/// Sobol points from Boost's Joe-Kuo direction numbers, in Gray-code order, so that any
/// block can be made on its own. A linear scramble is applied once to the 32 direction
/// numbers of a dimension in place of to every point.
/// Source: Joe and Kuo 2008; Matousek 1998. Left out: Owen's nested scramble, and more
/// than 2^32 points.
#include "stats/sobol_sequence.hpp"

#include "base/error.hpp"
#include "base/random.hpp"

#include <bit>
#include <vector>

#include <boost/random/sobol.hpp>

namespace bemcal::stats {
namespace {

constexpr int n_bits = 32;
constexpr std::uint32_t scramble_stream =
    0x534F424C;  ///< Stream's stage, apart from a plan's

using Bits = std::uint32_t;

/// What makes the points of one sequence: direction numbers and a shift for each
/// dimension.
struct Generator {
    std::size_t dimension = 0;
    std::vector<Bits> directions;  ///< [n_bits x dimension]
    std::vector<Bits> shift;       ///< [dimension]

    Bits* direction(int bit) {
        return directions.data() + static_cast<std::size_t>(bit) * dimension;
    }
};

/// Point 2^(c+1) - 1 of a Gray-coded sequence is direction number c itself.
Generator joe_kuo(int dimension) {
    require(dimension >= 1 && dimension <= max_sobol_dimension,
            "Sobol dimension out of range");
    Generator made{static_cast<std::size_t>(dimension), {}, {}};
    made.directions.resize(n_bits * made.dimension);
    made.shift.assign(made.dimension, 0);
    boost::random::sobol_engine<Bits, n_bits> engine(made.dimension);
    for (int bit = 0; bit < n_bits; ++bit) {
        engine.seed(static_cast<Bits>((std::uint64_t{2} << bit) - 2));
        engine.generate(made.direction(bit), made.direction(bit) + made.dimension);
    }
    return made;
}

/// A lower triangular binary matrix with a unit diagonal; rows and columns count from the
/// most significant bit.
struct LinearScramble {
    std::array<Bits, n_bits> rows;

    explicit LinearScramble(Stream& random) {
        for (int row = 0; row < n_bits; ++row) {
            const Bits diagonal = Bits{1} << (n_bits - 1 - row);
            const Bits more_significant = ~(diagonal | (diagonal - 1));
            rows[static_cast<std::size_t>(row)] =
                diagonal | (random() & more_significant);
        }
    }
    Bits operator()(Bits vector) const {
        Bits product = 0;
        for (const Bits row : rows)
            product = (product << 1) | static_cast<Bits>(std::popcount(row & vector) & 1);
        return product;
    }
};

void scramble(Generator& generator, std::uint64_t seed) {
    for (std::size_t d = 0; d < generator.dimension; ++d) {
        Stream random(seed, scramble_stream, d);
        const LinearScramble matrix(random);
        for (int bit = 0; bit < n_bits; ++bit) {
            Bits& direction = generator.direction(bit)[d];
            direction = matrix(direction);
        }
        generator.shift[d] = random();
    }
}

void combine(std::vector<Bits>& state, const Bits* direction) {
    for (std::size_t d = 0; d < state.size(); ++d) state[d] ^= direction[d];
}

std::vector<Bits> state_at(Generator& generator, std::uint64_t index) {
    std::vector<Bits> state = generator.shift;
    const std::uint64_t gray = index ^ (index >> 1);
    for (int bit = 0; bit < n_bits; ++bit)
        if ((gray >> bit) & 1) combine(state, generator.direction(bit));
    return state;
}

Matrix points_of(Generator& generator, std::size_t first, std::size_t n) {
    require(first + n <= (std::uint64_t{1} << n_bits),
            "a Sobol sequence has 2^32 points");
    Matrix points(n, generator.dimension);
    if (n == 0) return points;
    std::vector<Bits> state = state_at(generator, first);
    for (std::size_t k = 0; k < n; ++k) {
        if (k > 0) combine(state, generator.direction(std::countr_zero(first + k)));
        const auto row = points.row(k);
        for (std::size_t d = 0; d < state.size(); ++d) row[d] = state[d] * 0x1p-32;
    }
    return points;
}

}  // namespace

Matrix sobol_points(std::size_t first, std::size_t n, int dimension) {
    Generator generator = joe_kuo(dimension);
    return points_of(generator, first, n);
}

Matrix scrambled_sobol_points(std::size_t first, std::size_t n, int dimension,
                              std::uint64_t seed) {
    Generator generator = joe_kuo(dimension);
    scramble(generator, seed);
    return points_of(generator, first, n);
}

}  // namespace bemcal::stats
