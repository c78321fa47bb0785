#include "util/thread_priority.h"

#ifdef __linux__
#include <sys/resource.h>
#include <unistd.h>
#endif

namespace cpslam {

void give_way_to_other_threads() {
#ifdef __linux__
  constexpr int kNice = 19;  // the most; its share of a busy core is then 1.5 % of another thread's
  // Linux has a nice value for each thread, not for the process as POSIX would have it. Refused where the
  // value is higher already, which is as well.
  setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), kNice);
#endif
}

}  // namespace cpslam
