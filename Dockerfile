# The program without its tests and without pictures, on Debian 12. In the folder of a deck:
#
#   docker build -t kaya PATH-OF-THIS-FOLDER
#   docker run --rm -v "$PWD:/decks" kaya slope.3dd
# KAYA_ARCH is the target processor: x86-64-v3 runs on processors since 2013 (AMD: 2015), with the same bits as `native`.
FROM debian:12
COPY . /opt/kaya
WORKDIR /opt/kaya
RUN scripts/install && rm -rf /var/lib/apt/lists
ARG KAYA_ARCH=x86-64-v3
RUN cmake --preset release -DBUILD_TESTING=OFF -DKAYA_PAINTER=OFF -DKAYA_ARCH=$KAYA_ARCH \
    && cmake --build build/release --target program \
    && find build/release -name '*.o' -delete \
    && ln -s /opt/kaya/build/release/kaya /usr/local/bin/kaya
WORKDIR /decks
ENTRYPOINT ["kaya"]
