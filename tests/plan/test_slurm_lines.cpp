#include "plan/slurm_lines.hpp"

#include <gtest/gtest.h>

namespace bemcal::job {
namespace {

TEST(SlurmLines, AShortJobAsksForOneCoreAndLittleMemory) {
    EXPECT_EQ(plan::slurm_lines({100, 5000, 1e6, 1e6, 60}, {}),
              "# 100 items, 5000 simulations, about 0.017 hours of one core\n"
              "#SBATCH --nodes=1 --ntasks-per-node=1 --cpus-per-task=1\n"
              "#SBATCH --mem=500M --time=00:20:00\n"
              "#SBATCH --signal=B:USR1@120 --requeue --open-mode=append\n");
}

TEST(SlurmLines, ALongJobAsksForCoresThatMakeItShort) {
    // Four hours on one core: eight make it half an hour; twice that and ten minutes.
    const std::string lines = plan::slurm_lines({1e5, 1e9, 4e9, 1e8, 4 * 3600}, {});
    EXPECT_NE(lines.find("--ntasks-per-node=1 --cpus-per-task=8\n"), std::string::npos);
    EXPECT_NE(lines.find("--time=01:10:00"), std::string::npos) << lines;
    // 1.5 (2 x 4 GB + 3 x 0.1 GB + 0.1 GB)
    EXPECT_NE(lines.find("--mem=12600M"), std::string::npos) << lines;
}

TEST(SlurmLines, WhatAnItemTakesWhileItIsWorkedOnIsAskedForOnEachRank) {
    plan::PlanCost cost{100, 5000, 0, 0, 60};
    cost.working_bytes = 1.2e9;  // 1.5 (1.2 GB + 0.1 GB)
    EXPECT_NE(plan::slurm_lines(cost, {}).find("--mem=2000M"), std::string::npos);
}

TEST(SlurmLines, TheUsersNodesAreFilledWithRanksOfEightCores) {
    const std::string lines = plan::slurm_lines({1e5, 1e9, 0, 0, 1e6}, {4, 64});
    EXPECT_NE(lines.find("--nodes=4 --ntasks-per-node=8 --cpus-per-task=8\n"),
              std::string::npos)
        << lines;
}

TEST(SlurmLines, NoMoreCoresThanItems) {
    const std::string lines = plan::slurm_lines({3, 0, 0, 0, 1e6}, {1, 64});
    EXPECT_NE(lines.find("--ntasks-per-node=1 --cpus-per-task=3\n"), std::string::npos)
        << lines;
}

TEST(SlurmLines, AtMostADayIsAskedFor) {
    EXPECT_NE(plan::slurm_lines({1e5, 0, 0, 0, 1e9}, {}).find("--time=24:00:00"),
              std::string::npos);
}

}  // namespace
}  // namespace bemcal::job
