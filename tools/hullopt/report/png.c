#include "report/png.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

struct bytes {
    unsigned char *data;
    size_t n;
};

static void put(struct bytes *b, const void *data, size_t n)
{
    memcpy(b->data + b->n, data, n);
    b->n += n;
}

static void put_u32(struct bytes *b, uint32_t value)
{
    const unsigned char big_endian[4] = {(unsigned char)(value >> 24), (unsigned char)(value >> 16),
                                         (unsigned char)(value >> 8), (unsigned char)value};
    put(b, big_endian, 4);
}

/* CRC-32 of ISO 3309, bit by bit; the pictures are small. */
static uint32_t crc32_of(const unsigned char *data, size_t n)
{
    uint32_t crc = 0xffffffffu;
    for (size_t i = 0; i < n; i++) {
        crc ^= data[i];
        for (int k = 0; k < 8; k++)
            crc = crc & 1 ? (crc >> 1) ^ 0xedb88320u : crc >> 1;
    }
    return ~crc;
}

static uint32_t adler32_of(const unsigned char *data, size_t n)
{
    uint32_t a = 1, b = 0;
    for (size_t i = 0; i < n; i++) {
        a = (a + data[i]) % 65521;
        b = (b + a) % 65521;
    }
    return b << 16 | a;
}

static void put_chunk(struct bytes *b, const char *type, const unsigned char *data, size_t n)
{
    put_u32(b, (uint32_t)n);
    size_t start = b->n;
    put(b, type, 4);
    put(b, data, n);
    put_u32(b, crc32_of(b->data + start, n + 4));
}

/* A zlib stream of stored blocks (RFC 1950, 1951) of at most 65535 bytes each. */
static void store_zlib(struct bytes *b, const unsigned char *data, size_t n)
{
    static const unsigned char head[2] = {0x78, 0x01};
    put(b, head, 2);
    for (size_t at = 0; at < n;) {
        size_t length = n - at < 65535 ? n - at : 65535;
        const unsigned char block[5] = {at + length == n, (unsigned char)length,
                                        (unsigned char)(length >> 8), (unsigned char)~length,
                                        (unsigned char)(~length >> 8)};
        put(b, block, 5);
        put(b, data + at, length);
        at += length;
    }
    put_u32(b, adler32_of(data, n));
}

static void base64(FILE *out, const unsigned char *data, size_t n)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (size_t i = 0; i < n; i += 3) {
        uint32_t word = (uint32_t)data[i] << 16;
        word |= i + 1 < n ? (uint32_t)data[i + 1] << 8 : 0;
        word |= i + 2 < n ? data[i + 2] : 0;
        fputc(digits[word >> 18], out);
        fputc(digits[word >> 12 & 63], out);
        fputc(i + 1 < n ? digits[word >> 6 & 63] : '=', out);
        fputc(i + 2 < n ? digits[word & 63] : '=', out);
    }
}

bool png_data_uri(FILE *out, size_t width, size_t height, const unsigned char *pixels,
                  const unsigned char palette[256][3])
{
    static const unsigned char signature[8] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
    size_t raw = (width + 1) * height, room = raw + raw / 65535 * 5 + 64;
    struct bytes lines = {malloc(raw), 0}, stream = {malloc(room), 0},
                 file = {malloc(room + 2048), 0};
    bool ok = lines.data && stream.data && file.data;
    if (ok) {
        for (size_t j = 0; j < height; j++) {
            put(&lines, "", 1); /* no filter */
            put(&lines, pixels + j * width, width);
        }
        store_zlib(&stream, lines.data, lines.n);
        unsigned char header[13] = {0};
        struct bytes h = {header, 0};
        put_u32(&h, (uint32_t)width);
        put_u32(&h, (uint32_t)height);
        header[8] = 8; /* bits a sample */
        header[9] = 3; /* palette */
        put(&file, signature, 8);
        put_chunk(&file, "IHDR", header, 13);
        put_chunk(&file, "PLTE", palette[0], 768);
        put_chunk(&file, "IDAT", stream.data, stream.n);
        put_chunk(&file, "IEND", header, 0);
        fputs("data:image/png;base64,", out);
        base64(out, file.data, file.n);
    }
    free(lines.data);
    free(stream.data);
    free(file.data);
    return ok;
}
