/// The ranks that a test program was started on (support/mpi_main.cpp).
#pragma once

#include "run/comm.hpp"

namespace bemcal::test {

run::Comm& world();

}  // namespace bemcal::test
