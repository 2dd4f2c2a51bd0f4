/// Tells the allocator to keep what is freed, up to a limit.
/// Follows from glibc's mallopt(3); other libraries keep their ways.
/// What a run needs at once is left to `plan`.
#include "run/memory.hpp"

#include <cstdlib>
#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace bemcal::run {

void keep_freed_memory() {
#ifdef __GLIBC__
    constexpr int most_kept = 256 << 20;  ///< [bytes] a model's largest array is a tenth
    mallopt(M_MMAP_THRESHOLD, most_kept);
    mallopt(M_TRIM_THRESHOLD, most_kept);
#endif
}

}  // namespace bemcal::run
