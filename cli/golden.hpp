// The parts of `lorentz golden`, one file each.
#pragma once

#include "cli/command.hpp"

namespace lorentz::cli {

Command golden_make_command();
Command golden_add_command();
Command golden_check_command();
Command golden_verify_command();
Command golden_list_command();
Command golden_explain_command();
Command golden_export_command();
Command golden_index_command();
Command golden_merge_command();
Command golden_filter_command();
Command golden_sample_command();

}  // namespace lorentz::cli
