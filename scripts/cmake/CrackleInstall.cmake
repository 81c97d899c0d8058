# Install rules and the CMake package: see this file for what find_package(crackle) gives.
