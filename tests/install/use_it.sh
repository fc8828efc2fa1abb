#!/bin/sh
# Installs a build into a folder of its own, then builds and runs programs against it, found by find_package
# and by pkg-config. Usage: use_it.sh BUILD_FOLDER C++_COMPILER
set -eu
here=$(cd "$(dirname "$0")" && pwd)
build=$1 compiler=$2
stage=$build/tests/install
rm -rf "$stage"
cmake --install "$build" --prefix "$stage/prefix" >"$build/install.log"
# Moved after the fact: nothing installed may remember where it was.
mv "$stage/prefix" "$stage/moved"

if [ -e "$stage/moved/bin/petzval" ]; then
    for page in man/man1/petzval.1 bash-completion/completions/petzval zsh/site-functions/_petzval \
        fish/vendor_completions.d/petzval.fish; do
        test -s "$stage/moved/share/$page"
    done
fi

components=
for component in files scenes scene-files ocio; do
    if [ -e "$stage"/moved/lib/*/libpetzval_$component.a ] || [ -e "$stage/moved/lib/libpetzval_$component.a" ]; then
        components="$components$component;"
    fi
done

cmake -S "$here" -B "$stage/cmake" -G Ninja -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_PREFIX_PATH="$stage/moved" -DCOMPONENTS="$components" >"$stage/configure.log" 2>&1 || {
    cat "$stage/configure.log"
    exit 1
}
cmake --build "$stage/cmake"

PKG_CONFIG_PATH=$(dirname "$(find "$stage/moved" -name petzval.pc)")
export PKG_CONFIG_PATH
for consumer in consumer $(echo "$components" | tr ';' '\n' | sed 's/./consumer_&/'); do
    module=$(echo "$consumer" | sed 's/consumer/petzval/; s/_/-/')
    # shellcheck disable=SC2046  # flags are words
    "$compiler" -std=c++20 -Wall -Wextra -Werror "$here/$consumer.cpp" -o "$stage/$consumer" \
        $(pkg-config --cflags --libs "$module")
    echo "$consumer found by find_package:"
    "$stage/cmake/$consumer" "$stage"
    echo "$consumer found by pkg-config:"
    "$stage/$consumer" "$stage"
done

# Every block of code of the page about the library, as its readers would compile it, run beside a beauty.exr.
python3 "$here/../docs/library_blocks.py" "$here/../../docs/reference/library.md" "$stage/blocks" 2 1
for block in "$stage"/blocks/*.cpp; do
    module=petzval
    if grep -q petzval/shot.h "$block"; then
        module=petzval-files
        [ -e "$stage/beauty.exr" ] || continue
    fi
    # shellcheck disable=SC2046
    "$compiler" -std=c++20 -Wall -Wextra -Werror "$block" -o "${block%.cpp}" $(pkg-config --cflags --libs $module)
    (cd "$stage" && "${block%.cpp}")
done
for block in "$stage"/blocks/*.c; do
    # shellcheck disable=SC2046
    cc -std=c99 -Wall -Werror "$block" -o "${block%.c}_c" $(pkg-config --cflags --libs petzval-c)
    LD_LIBRARY_PATH=$(pkg-config --variable=libdir petzval-c) "${block%.c}_c"
done
