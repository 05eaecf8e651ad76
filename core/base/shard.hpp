#pragma once

namespace pliant::base {

/// One of `count` shares of a large job, from 1 on. Task k of the job, from 0 on, belongs to the share 1 + k mod count.
struct Shard {
  int index = 1, count = 1;

  bool takes(int task) const { return task % count == index - 1; }
};

}  // namespace pliant::base
