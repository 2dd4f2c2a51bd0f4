/// Work that every rank does at the same time, and whose failure on one is the failure of
/// all.
#pragma once

#include "run/comm.hpp"

#include <functional>

namespace bemcal::run {

/// Runs `work` on every rank, which must call this together. A UserError on any rank is
/// thrown on all of them: the first rank's, with its rank and host where it is not rank
/// 0.
void together(Comm& comm, const std::function<void()>& work);

}  // namespace bemcal::run
