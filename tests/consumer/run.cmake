# Installs the library, builds the project beside this file with it and runs it. The program must
# give the same history for the case that the library ran.
include(${CMAKE_CURRENT_LIST_DIR}/do.cmake)

file(REMOVE_RECURSE ${WORK})
do(${CMAKE_COMMAND} --install ${BUILD} --component library --prefix ${WORK}/prefix)
do(${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR} -B ${WORK}/build
   -DCMAKE_PREFIX_PATH=${WORK}/prefix -DCMAKE_CXX_COMPILER=${COMPILER}
   -DCMAKE_BUILD_TYPE=${BUILD_TYPE} "-DCMAKE_CXX_FLAGS=${FLAGS}")
do(${CMAKE_COMMAND} --build ${WORK}/build)
do(${WORK}/build/consumer ${WORK}/results)
do(${PROGRAM} run ${WORK}/results/case.toml --out ${WORK}/again --quiet)
do(${CMAKE_COMMAND} -E compare_files ${WORK}/results/history.csv ${WORK}/again/history.csv)
