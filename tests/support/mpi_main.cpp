/// main() of tests that run on several ranks: every rank runs every test; one failing
/// rank fails the program; only rank 0 prints what went well.
#include "support/mpi_world.hpp"

#include <gtest/gtest.h>

namespace bemcal::test {

run::Comm*& world_pointer() {
    static run::Comm* world = nullptr;
    return world;
}

run::Comm& world() {
    return *world_pointer();
}

}  // namespace bemcal::test

int main(int argc, char** argv) {
    ::testing::InitGoogleTest(&argc, argv);
    bemcal::run::Comm comm(&argc, &argv);
    bemcal::test::world_pointer() = &comm;
    auto& listeners = ::testing::UnitTest::GetInstance()->listeners();
    if (comm.rank() != 0) delete listeners.Release(listeners.default_result_printer());
    const int failed = RUN_ALL_TESTS();
    if (failed && comm.rank() != 0) std::fprintf(stderr, "rank %d failed\n", comm.rank());
    return failed;
}
