#pragma once

#include "command.h"

namespace hexwall {

/// `hexwall generate`: surfaces to try hexwall on.
Command add_generate(CLI::App& app);

}  // namespace hexwall
