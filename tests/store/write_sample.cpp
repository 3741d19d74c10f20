// Writes result.h5 and campaign.h5 of the sample into a folder, for check_written.py.

#include "sample_record.hpp"
#include "store/result_file.hpp"

#include <cstdio>
#include <exception>

int main(int argc, char** argv) {
    using namespace vibrotrough::store;
    if (argc != 2) {
        std::fprintf(stderr, "usage: write_sample FOLDER\n");
        return 2;
    }
    try {
        std::filesystem::path const folder = argv[1];
        std::filesystem::create_directories(folder);
        write_result(folder / "result.h5", sample_record());
        CaseRecord studied = sample_record();
        studied.studied = {0.034, "fedcba9876543210"};
        write_campaign(folder / "campaign.h5", "sample", {studied, sample_record("fedcba9876543210", 27.0)},
                       {vibrotrough::scenario::find_key("trough.frequency"),
                        vibrotrough::scenario::find_key("grains.rotation")});
        return 0;
    } catch (std::exception const& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
